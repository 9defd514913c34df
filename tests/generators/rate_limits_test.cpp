#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/tests/generators/effect_series.hpp>

namespace gyrostat::rate_limits_test {
namespace {

TEST(Saturation, ClipsAtBothLimitsAndPassesWhatLiesBetweenAndGaps) {
  const auto z = sensed(effects::Saturation{.limit_dps = 30.0},
                        {29.0, 31.0, -31.0, -30.0, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ((std::vector<double>(z.begin(), z.begin() + 4)),
            (std::vector<double>{29.0, 30.0, -30.0, -30.0}));
  EXPECT_TRUE(std::isnan(z[4]));
}

TEST(Saturation, MayHaveAnotherLimitBelowZero) {
  const auto z =
      sensed(effects::Saturation{.limit_dps = 30.0, .below_dps = 40.0}, {29.0, 31.0, -31.0, -41.0});
  EXPECT_EQ(z, (std::vector<double>{29.0, 30.0, -31.0, -40.0}));
}

/// From 36 to 44 a parabola, which has the slope of both sides at its ends.
TEST(Saturation, BendsIntoItsLimitOverItsKnee) {
  const auto z = sensed(effects::Saturation{.limit_dps = 40.0, .knee = 0.1},
                        {35.0, 36.0, 36.001, 40.0, -40.0, 43.999, 44.0, 90.0, -90.0});
  EXPECT_EQ(z[0], 35.0);
  EXPECT_EQ(z[1], 36.0);
  EXPECT_NEAR(z[2], 36.001, 1e-6);
  EXPECT_NEAR(z[3], 39.0, 1e-12);
  EXPECT_NEAR(z[4], -39.0, 1e-12);
  EXPECT_NEAR(z[5], 40.0, 1e-6);
  for (const std::size_t i : {6u, 7u}) EXPECT_NEAR(z[i], 40.0, 1e-12);
  EXPECT_EQ(z[8], -40.0);
}

TEST(Saturation, OfTheElementLeavesBiasAndNoise) {
  auto series = silent(even_times(3, 100.0));
  series.rate_ref_dps = {29.0, 31.0, -40.0};
  series.gyro_dps = {29.5, 31.5, -39.0};
  effects::Saturation{.limit_dps = 30.0, .of_element = 1.0}.apply(series, {1, 0});
  EXPECT_EQ(series.gyro_dps, (std::vector<double>{29.5, 30.5, -29.0}));
}

TEST(DeadZone, HidesRatesUpToItsHalfWidth) {
  EXPECT_EQ(sensed(effects::DeadZone{.half_width_dps = 0.5}, {0.5, -0.5, 0.3, 0.51, -0.51, 8.0}),
            (std::vector<double>{0.0, 0.0, 0.0, 0.51, -0.51, 8.0}));
}

TEST(DeadZone, MayTakeItsHalfWidthFromLargerRates) {
  EXPECT_EQ(
      sensed(effects::DeadZone{.half_width_dps = 0.5, .lost_beyond = 1.0}, {0.5, -0.5, 0.75, -8.0}),
      (std::vector{0.0, 0.0, 0.25, -7.5}));
}

TEST(DeadZone, MayEndElsewhereBelowZero) {
  EXPECT_EQ(sensed(effects::DeadZone{.half_width_dps = 0.5, .below_dps = 2.0},
                   {0.5, 0.51, -0.51, -2.0, -2.5}),
            (std::vector<double>{0.0, 0.51, 0.0, 0.0, -2.5}));
  EXPECT_EQ(sensed(effects::DeadZone{.half_width_dps = 0.5, .lost_beyond = 1.0, .below_dps = 2.0},
                   {0.75, -1.0, -2.5}),
            (std::vector<double>{0.25, 0.0, -0.5}));
}

/// The mean over a normal dither, by the midpoint rule.
TEST(DeadZone, IsRoundedByADither) {
  constexpr int steps = 20000;
  constexpr double reach = 8.0;
  for (const double lost : {0.0, 0.4, 1.0}) {
    const effects::DeadZone sharp{
        .half_width_dps = 0.5, .lost_beyond = lost, .below_dps = lost == 0.4 ? 0.8 : 0.0};
    auto rounded = sharp;
    rounded.dither = 0.3;
    for (const double rate : {0.0, 0.2, -0.45, 0.6, -3.0}) {
      std::vector<double> moved;
      for (int k = 0; k < steps; ++k)
        moved.push_back(rate + 0.15 * reach * ((2.0 * k + 1.0) / steps - 1.0));
      const auto each = sensed(sharp, moved);
      double mean = 0.0;
      for (std::size_t k = 0; k < each.size(); ++k) {
        const double z = (moved[k] - rate) / 0.15;
        mean += each[k] * std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi) * 2.0 * reach /
                steps;
      }
      EXPECT_NEAR(sensed(rounded, {rate})[0], mean, 1e-4) << lost << ' ' << rate;
    }
  }
}

TEST(DeadZone, LeavesBiasAndNoiseWhereTheyWere) {
  auto series = silent(even_times(2, 100.0));
  series.rate_ref_dps = {0.25, 0.0};
  series.gyro_dps = {0.75, 0.5};
  effects::DeadZone{.half_width_dps = 0.3}.apply(series, {1, 0});
  EXPECT_EQ(series.gyro_dps, (std::vector<double>{0.5, 0.5}));
}

TEST(DeadZone, OfTheOutputIsOfBiasAndNoise) {
  auto series = silent(even_times(4, 100.0));
  series.rate_ref_dps = {0.25, 0.0, 5.0, -5.0};
  series.gyro_dps = {0.75, -0.5, 5.5, -4.5};
  auto play = series;
  effects::DeadZone{.half_width_dps = 0.6, .of_output = 1.0}.apply(series, {1, 0});
  EXPECT_EQ(series.gyro_dps, (std::vector<double>{0.75, 0.0, 5.5, -4.5}));
  effects::DeadZone{.half_width_dps = 0.5, .lost_beyond = 1.0, .of_output = 1.0}.apply(play,
                                                                                       {1, 0});
  EXPECT_EQ(play.gyro_dps, (std::vector<double>{0.25, 0.0, 5.0, -4.0}));
}

}  // namespace
}  // namespace gyrostat::rate_limits_test
