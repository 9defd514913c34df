#include <gyrostat/results/pictures/picture.hpp>

#include <cmath>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <gyrostat/results/pictures/colours.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat::picture_test {
namespace {

using testing::HasSubstr;
using testing::Not;

Mark mark(Mark::Kind kind) {
  Mark m;
  m.kind = kind;
  m.name = "</script> & \"kf\"";
  m.colour = "m0";
  m.x = {1.0, NAN, 3.0};
  m.y = {0.0, 1.0, INFINITY};
  m.x_low = {0.5, 1.0, 2.0};
  m.x_high = {1.5, 2.0, 4.0};
  m.from = {0.1, 0.2, 0.3};
  m.to = {2.0, 2.0, 5.0};
  m.labels = {"a", "b", "c"};
  m.fills = {"#102030", "m1", "line"};
  return m;
}

Picture picture(Mark::Kind kind) {
  return {.id = "c",
          .title = "a < b",
          .note = "n",
          .x = {"x", "dps", false, {}},
          .y = {"", "", false, {"one", "two"}},
          .marks = {mark(kind)}};
}

constexpr Mark::Kind kinds[] = {Mark::Kind::line, Mark::Kind::points, Mark::Kind::bars,
                                Mark::Kind::boxes, Mark::Kind::cells};

TEST(Picture, EqualNumbersGiveEqualBytes) {
  for (const auto kind : kinds) EXPECT_EQ(html(picture(kind)), html(picture(kind)));
}

TEST(Picture, DrawsNoNumberThatIsNone) {
  for (const auto kind : kinds) {
    const auto text = html(picture(kind));
    EXPECT_THAT(text, Not(HasSubstr("nan")));
    EXPECT_THAT(text, Not(HasSubstr("inf")));
  }
}

TEST(Picture, NoNameEndsTheScriptElementOrAnAttribute) {
  for (const auto kind : kinds) {
    const auto text = html(picture(kind));
    EXPECT_EQ(text.find("</script>"), text.rfind("</script>"));
    EXPECT_THAT(text, Not(HasSubstr("& \"kf")));
  }
}

TEST(Picture, TheScriptHasTheNumbersAndNullForNone) {
  const auto json = nlohmann::json::parse(picture_json(picture(Mark::Kind::points)));
  const auto& m = json["marks"][0];
  EXPECT_EQ(m["kind"], "points");
  EXPECT_EQ(m["name"], "</script> & \"kf\"");
  EXPECT_EQ(m["x"], nlohmann::json({1.0, nullptr, 3.0}));
  EXPECT_EQ(m["y"], nlohmann::json({0.0, 1.0, nullptr}));
  EXPECT_EQ(json["y"]["names"], nlohmann::json({"one", "two"}));
}

TEST(Picture, OfNothingIsStillAPicture) {
  EXPECT_THAT(picture_svg({}), HasSubstr("</svg>"));
  auto log = picture(Mark::Kind::line);
  log.x.logarithmic = log.y.logarithmic = true;
  log.marks[0].y = {-1.0, 0.0, NAN};
  EXPECT_THAT(picture_svg(log), Not(HasSubstr("nan")));
}

TEST(Picture, WhatIsNotShownIsNotDrawn) {
  auto hidden = picture(Mark::Kind::points);
  hidden.marks[0].shown = false;
  EXPECT_THAT(picture_svg(picture(Mark::Kind::points)), HasSubstr("<circle"));
  EXPECT_THAT(picture_svg(hidden), Not(HasSubstr("<circle")));
}

TEST(Picture, TheRampIsAColourForEveryShareAndGreyForNone) {
  for (const double share : {-1.0, 0.0, 0.3, 1.0, 2.0})
    EXPECT_EQ(ramp(share).size(), share < 0.0 ? 4U : 7U);
  EXPECT_EQ(ramp(NAN), "line");
  EXPECT_NE(ramp(0.0), ramp(1.0));
}

TEST(Html, ATableKeepsItsNumbersUnitsAndNotes) {
  const Table table{.title = "T<",
                    .columns = {{"method", ""}, {"mean", "dps"}},
                    .rows = {{"kf", 0.25}, {"a&b", {}}},
                    .notes = {"n>"}};
  const auto text = html(table);
  for (const char* part : {"T&lt;", "mean [dps]", ">kf<", ">0.25<", "a&amp;b", ">–<", "n&gt;"})
    EXPECT_THAT(text, HasSubstr(part));
}

TEST(Html, APageAsksNobodyForAnything) {
  const auto page = html_page("t", "", "<p>b</p>");
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, Not(HasSubstr("http://")));
  EXPECT_THAT(page, Not(HasSubstr("https://")));
}

}  // namespace
}  // namespace gyrostat::picture_test
