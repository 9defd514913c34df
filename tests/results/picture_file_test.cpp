#include <cmath>

#include <gmock/gmock.h>

#include <gyrostat/results/pictures/colours.hpp>
#include <gyrostat/results/pictures/lettering.hpp>
#include <gyrostat/results/pictures/picture.hpp>

namespace gyrostat::picture_file_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Mark line(const std::string& name, std::vector<double> y) {
  Mark m;
  m.name = name;
  m.colour = "m0";
  m.x = {1, 2, 3};
  m.y = std::move(y);
  return m;
}

Picture lines() {
  Picture picture{.title = "a < b & c", .x = {"t", "s"}, .y = {"y"}};
  picture.marks = {line("one", {1, NAN, 4}), line("two", {0, 1, 2})};
  picture.marks[1].y_low = {-1, 0, 1};
  picture.marks[1].y_high = {1, 2, 3};
  return picture;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(PictureFile, StandsAlone) {
  const auto text = picture_file(lines());
  EXPECT_EQ(text, picture_file(lines()));
  EXPECT_THAT(text, HasSubstr("xmlns="));
  EXPECT_THAT(text, Not(HasSubstr("var(")));
  EXPECT_THAT(text, HasSubstr(light_colour("m0")));
  for (const char* said : {"a &lt; b &amp; c", ">t [s]<", ">one<", ">two<"})
    EXPECT_THAT(text, HasSubstr(said));
}

TEST(PictureFile, DrawsEachLineAndBandAndNoNumberThatIsNone) {
  const auto text = picture_file(lines());
  EXPECT_EQ(count(text, "<polygon"), 1);
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  auto log = lines();
  log.x.logarithmic = log.y.logarithmic = true;
  EXPECT_THAT(picture_file(log), Not(HasSubstr("nan")));
  EXPECT_THAT(picture_file(log), Not(HasSubstr("inf")));
  EXPECT_THAT(picture_file({}), HasSubstr("</svg>"));
}

TEST(PictureFile, GivesEachNameAPanelUnderTheSameAxes) {
  auto panels = lines();
  const auto once = count(picture_file(panels), ">2</text>");
  panels.panels = true;
  EXPECT_GT(count(picture_file(panels), ">2</text>"), once);  // numbers of y stand at each
  EXPECT_EQ(count(picture_file(panels), ">one<"), 1);
}

TEST(PictureFile, DrawsEveryNumberOfAMap) {
  Picture map{.title = "m", .note = "how to read it"};
  Mark cells, least;
  cells.kind = least.kind = Mark::Kind::cells;
  least.strong = true;
  for (int c = 0; c < 30; ++c) {
    map.x.names.push_back("a_long_name_of_a_method");
    auto& mark = c == 7 ? least : cells;
    mark.x.push_back(c), mark.y.push_back(0);
    mark.labels.push_back("0.000123"), mark.fills.push_back("#ffffff");
  }
  map.y.names = {"row"};
  map.marks = {cells, least};
  const auto text = picture_file(map);
  EXPECT_EQ(count(text, ">0.000123<"), 30);
  EXPECT_EQ(count(text, "font-weight:bold"), 1);
  EXPECT_THAT(text, HasSubstr("how to read it"));
}

TEST(Colours, ARatioIsWhiteAtOneAndRedAtTenAndAbove) {
  EXPECT_EQ(ratio_colour(1.0), "#ffffff");
  EXPECT_EQ(ratio_colour(0.5), "#ffffff");
  EXPECT_EQ(ratio_colour(NAN), "#ffffff");
  EXPECT_EQ(ratio_colour(10.0), "#d73027");
  EXPECT_EQ(ratio_colour(1e6), "#d73027");
}

TEST(Colours, InLightAreThoseOfTheStyle) {
  for (const char* property : {"paper", "ink", "soft", "line", "m0", "m7", "none", "oracle"})
    EXPECT_THAT(light_colour(property), testing::MatchesRegex("#[0-9a-f]{6}")) << property;
  EXPECT_EQ(light_colour("paper"), "#ffffff");
}

TEST(Lettering, CountsLettersNotBytesAndKeepsBothEnds) {
  using namespace render_detail;
  EXPECT_EQ(length_of("µ−½"), 3.0 * letter);
  EXPECT_EQ(shortened("short", 100.0), "short");
  const auto name = shortened("delta1_dps=0.001, phi=−½", 12.0 * letter);
  EXPECT_LE(length_of(name), 12.0 * letter);
  EXPECT_THAT(name, HasSubstr("…"));
  EXPECT_THAT(name, testing::EndsWith("−½"));
  EXPECT_THAT(lines_within("one two three", 8.0 * letter), ElementsAre("one two", "three"));
  EXPECT_THAT(lines_within("", 8.0), ElementsAre());
}

}  // namespace
}  // namespace gyrostat::picture_file_test
