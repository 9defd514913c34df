#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/tests/generators/effect_series.hpp>

namespace gyrostat::motion_effects_test {
namespace {

TEST(ScaleFactor, AddsItsShareOfTheRate) {
  const auto z = sensed(effects::ScaleFactor{.error = 0.02}, {100.0, -50.0, 0.0});
  EXPECT_DOUBLE_EQ(z[0], 102.0);
  EXPECT_DOUBLE_EQ(z[1], -51.0);
  EXPECT_EQ(z[2], 0.0);
}

TEST(ScaleAsymmetry, AddsTheSameToBothDirections) {
  const auto z = sensed(effects::ScaleAsymmetry{.error = 0.02}, {100.0, -100.0, 0.0});
  EXPECT_DOUBLE_EQ(z[0], 102.0);
  EXPECT_DOUBLE_EQ(z[1], -98.0);
  EXPECT_EQ(z[2], 0.0);
}

TEST(ScaleAsymmetry, OfOneSideLeavesTheOther) {
  EXPECT_EQ(sensed(effects::ScaleAsymmetry{0.25, 1.0}, {4.0, -4.0}), (std::vector{6.0, -4.0}));
  EXPECT_EQ(sensed(effects::ScaleAsymmetry{0.25, -1.0}, {4.0, -4.0}), (std::vector{4.0, -2.0}));
  EXPECT_EQ(sensed(effects::ScaleAsymmetry{0.25}, {4.0, -4.0}), (std::vector{5.0, -3.0}));
}

TEST(GSensitivity, AddsEachAxisByItsCoefficient) {
  auto series = silent(even_times(2, 100.0));
  series.acc_x_mps2 = {1.0, 0.0};
  series.acc_y_mps2 = {2.0, 0.0};
  series.acc_z_mps2 = {9.0, -9.0};
  effects::GSensitivity{.x_dps_per_mps2 = 1.0, .y_dps_per_mps2 = 10.0, .z_dps_per_mps2 = 100.0}
      .apply(series, {1, 0});
  EXPECT_EQ(series.gyro_dps, (std::vector<double>{921.0, -900.0}));
}

TEST(ScaleTemperature, CurvesAboutItsReference) {
  auto series = silent(even_times(3, 100.0));
  series.rate_ref_dps = {100.0, 100.0, -10.0};
  series.temperature_C = {20.0, 30.0, 40.0};
  effects::ScaleTemperature{0.001, 30.0, 0.0002}.apply(series, {1, 0});
  EXPECT_NEAR(series.gyro_dps[0], 100.0 * (-0.01 + 0.02), 1e-12);
  EXPECT_EQ(series.gyro_dps[1], 0.0);
  EXPECT_NEAR(series.gyro_dps[2], -10.0 * (0.01 + 0.02), 1e-12);
}

TEST(Misalignment, AddsItsShareOfEachOtherAxis) {
  auto series = silent(even_times(2, 100.0));
  series.cross_rate_1_dps = {100.0, 0.0};
  series.cross_rate_2_dps = {10.0, -10.0};
  effects::Misalignment{.share_1 = 0.02, .share_2 = -0.1}.apply(series, {1, 0});
  EXPECT_DOUBLE_EQ(series.gyro_dps[0], 1.0);
  EXPECT_DOUBLE_EQ(series.gyro_dps[1], 1.0);
}

TEST(ScaleTemperature, AddsItsShareOfTheRateForEachDegree) {
  auto series = silent(even_times(3, 100.0));
  series.rate_ref_dps = {100.0, 100.0, -50.0};
  series.temperature_C = {25.0, 35.0, 5.0};
  effects::ScaleTemperature{.scale_per_C = 1e-3, .reference_C = 25.0}.apply(series, {1, 0});
  EXPECT_EQ(series.gyro_dps[0], 0.0);
  EXPECT_DOUBLE_EQ(series.gyro_dps[1], 1.0);
  EXPECT_DOUBLE_EQ(series.gyro_dps[2], 1.0);
}

}  // namespace
}  // namespace gyrostat::motion_effects_test
