#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/tests/generators/effect_series.hpp>

namespace gyrostat {
namespace {

/// The gyro of a noiseless sensor with this effect at these rates, 0.01 s apart.
template <class Effect>
std::vector<double> sensed(const Effect& effect, const std::vector<double>& rates) {
  auto series = silent(even_times(rates.size(), 100.0));
  series.rate_ref_dps = series.gyro_dps = rates;
  effect.apply(series, {1, 0});
  return series.gyro_dps;
}

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

TEST(SensorBandwidth, ApproachesAStepExponentially) {
  std::vector<double> step(101, 10.0);
  step[0] = 0.0;
  const auto z = sensed(effects::SensorBandwidth{.cutoff_hz = 2.0}, step);
  EXPECT_EQ(z[0], 0.0);
  for (std::size_t k = 1; k < step.size(); ++k)
    EXPECT_NEAR(z[k],
                10.0 * (1.0 - std::exp(-4.0 * std::numbers::pi * 0.01 * static_cast<double>(k))),
                1e-9);
}

/// Four hundred samples a period, so that holding the rate over an interval is within 1 %.
TEST(SensorBandwidth, HasHalfThePowerAtItsCutoff) {
  std::vector<double> sine;
  for (int i = 0; i < 4000; ++i) sine.push_back(std::sin(2.0 * std::numbers::pi * i / 400.0));
  const auto z = sensed(effects::SensorBandwidth{.cutoff_hz = 0.25}, sine);
  EXPECT_NEAR(mean_square({z.end() - 400, z.end()}), 0.25, 0.005);
}

TEST(SensorBandwidth, OverUnevenIntervalsIsTheSameResponse) {
  auto series = silent({0.0, 0.1, 0.15, 0.9});
  series.rate_ref_dps = series.gyro_dps = {0.0, 5.0, 5.0, 5.0};
  effects::SensorBandwidth{.cutoff_hz = 1.0}.apply(series, {1, 0});
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(series.gyro_dps[i], 5.0 * (1.0 - std::exp(-2.0 * std::numbers::pi * series.t_s[i])),
                1e-12);
}

TEST(Saturation, ClipsAtBothLimitsAndPassesWhatLiesBetweenAndGaps) {
  const auto z = sensed(effects::Saturation{.limit_dps = 30.0},
                        {29.0, 31.0, -31.0, -30.0, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ((std::vector<double>(z.begin(), z.begin() + 4)),
            (std::vector<double>{29.0, 30.0, -30.0, -30.0}));
  EXPECT_TRUE(std::isnan(z[4]));
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

TEST(DeadZone, LeavesBiasAndNoiseWhereTheyWere) {
  auto series = silent(even_times(2, 100.0));
  series.rate_ref_dps = {0.25, 0.0};
  series.gyro_dps = {0.75, 0.5};
  effects::DeadZone{.half_width_dps = 0.3}.apply(series, {1, 0});
  EXPECT_EQ(series.gyro_dps, (std::vector<double>{0.5, 0.5}));
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

/// What the effect adds to the drift at these temperatures, 1 s apart.
std::vector<double> lag(const effects::ThermalLag& effect,
                        const std::vector<double>& temperature_C) {
  auto series = silent(even_times(temperature_C.size(), 1.0));
  series.temperature_C = temperature_C;
  effect.apply(series, {1, 0});
  return series.thermal_bias_dps;
}

TEST(ThermalLag, DecaysAfterAStepWithItsTimeConstant) {
  std::vector<double> step(61, 30.0);
  step[0] = 20.0;
  const auto bias = lag({.sensitivity_dps_per_C = 0.01, .time_constant_s = 20.0}, step);
  EXPECT_EQ(bias[0], 0.0);
  for (std::size_t k = 1; k < step.size(); ++k)
    EXPECT_NEAR(bias[k], -0.1 * std::exp(-static_cast<double>(k) / 20.0), 1e-14);
}

/// Each interval the lag grows by the rise D and decays: e = exp(-1/20) (e + D), about 19.5 D.
TEST(ThermalLag, BehindAnEvenRampIsConstant) {
  std::vector<double> ramp;
  for (int i = 0; i < 1000; ++i) ramp.push_back(20.0 + 0.01 * i);
  const auto bias = lag({.sensitivity_dps_per_C = 0.01, .time_constant_s = 20.0}, ramp);
  EXPECT_NEAR(bias.back(), -0.01 * 0.01 / std::expm1(1.0 / 20.0), 1e-14);
  EXPECT_NEAR(bias.back(), bias[900], 1e-12);
}

TEST(ThermalLag, AtConstantTemperatureIsNothing) {
  for (const double b : lag({}, std::vector<double>(100, 55.0))) EXPECT_EQ(b, 0.0);
}

}  // namespace
}  // namespace gyrostat
