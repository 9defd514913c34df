#include <gyrostat/results/render/figure.hpp>

#include <cmath>

#include <gmock/gmock.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/results/render/render.hpp>

namespace gyrostat {
namespace {

using testing::HasSubstr;
using testing::Not;

LineChart chart() {
  return {
      .title = "a < b & c",
      .x_label = "t [s]",
      .y_label = "y",
      .lines = {
          {.name = "one", .x = {1, 2, 3}, .y = {1, NAN, 4}, .low = {}, .high = {}},
          {.name = "two", .x = {1, 2, 3}, .y = {0, 1, 2}, .low = {-1, 0, 1}, .high = {1, 2, 3}}}};
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(LineChart, EqualNumbersGiveEqualBytes) { EXPECT_EQ(svg(chart()), svg(chart())); }

TEST(LineChart, DrawsEachLineAndBandAndNoNumberThatIsNone) {
  const auto text = svg(chart());
  EXPECT_EQ(count(text, "<polyline"), 2);
  EXPECT_EQ(count(text, "<polygon"), 1);
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_THAT(text, Not(HasSubstr("inf")));
  EXPECT_THAT(text, HasSubstr("a &lt; b &amp; c"));
}

TEST(LineChart, OnLogarithmicAxesLeavesOutWhatHasNoLogarithm) {
  auto log = chart();
  log.logarithmic = true;
  EXPECT_THAT(svg(log), Not(HasSubstr("nan")));
  EXPECT_THAT(svg(log), Not(HasSubstr("inf")));
}

TEST(LineChart, OfNothingIsStillAPicture) { EXPECT_THAT(svg(LineChart{}), HasSubstr("</svg>")); }

TEST(LineChart, GivesEachLineAPanel) {
  auto panels = chart();
  panels.panels = true;
  EXPECT_EQ(count(svg(panels), "stroke=\"#555555\""), 2);
}

TEST(HeatMap, MarksTheLeastOfEachRowAmongTheRanked) {
  const HeatMap map{.title = "m",
                    .rows = {"r"},
                    .columns = {"a", "b", "best"},
                    .values = {{2.0, 20.0, 1.0}},
                    .ranked = {true, true, false}};
  const auto text = svg(map);
  EXPECT_EQ(count(text, "font-weight=\"bold\""), 1);
  EXPECT_THAT(text, HasSubstr("font-weight=\"bold\">2<"));
  EXPECT_THAT(text, HasSubstr("#d73027"));  // ten times the least: the end of the scale
  EXPECT_THAT(text, HasSubstr("#ffffff"));
}

TEST(ParseTables, GivesBackWhatWasRendered) {
  const std::vector<Table> tables = {{.title = "t",
                                      .columns = {{"a", ""}, {"b", "dps"}},
                                      .rows = {{std::string("x|y"), 0.1}, {std::int64_t{3}, {}}},
                                      .notes = {"n"}},
                                     {.title = "empty", .columns = {}}};
  const auto back = parse_tables(render(tables, Format::json), "here");
  for (const auto format : {Format::json, Format::csv, Format::markdown})
    EXPECT_EQ(render(back, format), render(tables, format));
}

TEST(ParseTables, NamesThePlaceOfAnythingElse) {
  for (const char* json : {"", "{", "[1]", "[{\"title\": 1}]", "{\"a\": 1}"})
    EXPECT_THROW((void)parse_tables(json, "here"), InputError) << json;
}

/// Ranks 1, 1.5 and 3: a bar joins the first two alone.
TEST(RankDiagram, JoinsWhatTheCriticalDifferenceSpans) {
  const RankDiagram diagram{.title = "t",
                            .methods = {{"c", 3.0}, {"a", 1.0}, {"b", 1.5}, {"x", NAN}},
                            .critical_difference = 0.6};
  const auto text = svg(diagram);
  EXPECT_EQ(text, svg(diagram));
  EXPECT_EQ(count(text, "stroke-width=\"4\""), 1);
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_LT(text.find("a (1.00)"), text.find("b (1.50)"));
  auto wide = diagram;
  wide.critical_difference = 2.5;
  EXPECT_EQ(count(svg(wide), "stroke-width=\"4\""), 1) << "one bar over all";
}

}  // namespace
}  // namespace gyrostat
