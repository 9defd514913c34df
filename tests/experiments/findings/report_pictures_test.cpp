#include <cmath>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <gyrostat/experiments/findings/report/design_pictures.hpp>

namespace gyrostat::report_pictures_test {
namespace {

Study two_methods() {
  Study study;
  study.cells.emplace_back();
  study.cells[0].methods.push_back({"none", "none", ParameterSource::truth, {}, {}});
  study.cells[0].methods.push_back({"kf", "kf", ParameterSource::truth, {}, {}});
  return study;
}

Sensitivity of(const std::string& method) {
  Sensitivity s;
  s.design = "d", s.method = method, s.metric = "bias_rmse", s.unit = "dps";
  return s;
}

TEST(SensitivityPictures, AreThoseThatTheDesignAllows) {
  const MethodColours colours(two_methods());
  EXPECT_TRUE(sensitivity_pictures({}, colours, "d").empty());
  EXPECT_TRUE(sensitivity_pictures({of("kf")}, colours, "d").empty());
  auto kf = of("kf");
  kf.indices = {{"phi", {0.2, 0.1, 0.3}, {0.4, 0.3, 0.5}},
                {"noise", {0.05, 0.0, 0.1}, {0.6, 0.5, 0.7}}};
  const auto pictures = sensitivity_pictures({kf}, colours, "d");
  ASSERT_EQ(pictures.size(), 1U);
  EXPECT_EQ(pictures[0].id, "d-sobol");
}

TEST(SensitivityPictures, ATornadoHasTheLargestOnTopAndOneMethodAtATime) {
  const MethodColours colours(two_methods());
  auto kf = of("kf"), none = of("none");
  kf.elasticities = {{"phi", {0.1, 0.0, 0.2}, 1, 2}, {"delta1_dps", {-0.9, -1.0, -0.8}, 1, 2}};
  none.elasticities = {{"phi", {0.5, 0.4, 0.6}, 1, 2}, {"delta1_dps", {0.3, 0.2, 0.4}, 1, 2}};
  const auto picture = sensitivity_pictures({kf, none}, colours, "d").at(0);
  EXPECT_THAT(picture.y.names, testing::ElementsAre("delta1_dps", "phi"));
  EXPECT_TRUE(picture.exclusive);
  ASSERT_EQ(picture.marks.size(), 2U);
  EXPECT_TRUE(picture.marks[0].shown);
  EXPECT_FALSE(picture.marks[1].shown);
  EXPECT_THAT(picture.marks[0].y, testing::ElementsAre(1.0, 0.0));  // phi is in the second row
  EXPECT_THAT(picture.marks[1].x, testing::ElementsAre(0.5, 0.3));
  EXPECT_THAT(picture.marks[0].x_low, testing::ElementsAre(0.0, -1.0));
}

TEST(SensitivityPictures, AMorrisPlaneHasEachParameterWithItsIntervals) {
  const MethodColours colours(two_methods());
  auto kf = of("kf");
  kf.elementary_effects = {{"phi", {1.0, 0.8, 1.2}, {0.5, 0.4, 0.6}},
                           {"delta1_dps", {2.0, 1.5, 2.5}, {NAN, NAN, NAN}}};
  const auto picture = sensitivity_pictures({kf}, colours, "d").at(0);
  const auto& dots = picture.marks.back();
  EXPECT_THAT(dots.x, testing::ElementsAre(1.0, 2.0));
  EXPECT_EQ(dots.y_high[0], 0.6);
  EXPECT_THAT(dots.labels, testing::ElementsAre("phi", "delta1_dps"));
  EXPECT_EQ(picture_svg(picture).find("nan"), std::string::npos);
}

TEST(MethodColours, AreTheSameInEveryCellAndApartForEveryMethod) {
  Study study;
  study.cells.resize(2);
  for (int m = 0; m < 16; ++m)
    study.cells[0].methods.push_back({fmt::format("m{}", m), "kf", ParameterSource::truth, {}, {}});
  study.cells[1].methods = {study.cells[0].methods[9],
                            {"o", "oracle", ParameterSource::truth, {}, {}}};
  const MethodColours colours(study);
  std::set<std::pair<std::string, bool>> looks;
  for (const auto& method : study.cells[0].methods) {
    const auto mark = colours.mark(Mark::Kind::line, method.id);
    looks.emplace(mark.colour, mark.dashed);
  }
  EXPECT_EQ(looks.size(), 16U);
  EXPECT_EQ(colours.of("o"), "oracle");
}

}  // namespace
}  // namespace gyrostat::report_pictures_test
