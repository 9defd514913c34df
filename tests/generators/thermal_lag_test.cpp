#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/tests/generators/effect_series.hpp>

namespace gyrostat::thermal_lag_test {
namespace {

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

/// Of k equal poles after a step exp(-x) (1 + x + ... ), x in time constants of one, is left to
/// follow.
TEST(ThermalLag, OfTwoPolesAddsTheirTimeConstants) {
  std::vector<double> step(61, 30.0);
  step[0] = 20.0;
  const auto bias =
      lag({.sensitivity_dps_per_C = 0.01, .time_constant_s = 40.0, .poles = 2.0}, step);
  // Held over intervals of 1 s, of which both poles keep r = exp(-1 / 20): k r^k (1 - r) + r^k.
  const double r = std::exp(-1.0 / 20.0);
  for (std::size_t k = 1; k < step.size(); ++k) {
    const auto n = static_cast<double>(k);
    EXPECT_NEAR(bias[k], -0.1 * std::pow(r, n) * (1.0 + n * (1.0 - r)), 1e-14) << k;
  }
}

/// At a constant temperature, of which the masses know nothing at first.
TEST(ThermalLag, MayBeginAwayFromItsTemperature) {
  const std::vector<double> even(61, 30.0);
  const auto one =
      lag({.sensitivity_dps_per_C = 0.0, .time_constant_s = 20.0, .start_dps = 0.02}, even);
  const auto two =
      lag({.sensitivity_dps_per_C = 0.0, .time_constant_s = 40.0, .poles = 2.0, .start_dps = 0.02},
          even);
  const double r = std::exp(-1.0 / 20.0);
  for (std::size_t k = 0; k < even.size(); ++k) {
    const auto n = static_cast<double>(k);
    EXPECT_NEAR(one[k], 0.02 * std::pow(r, n), 1e-15) << k;
    EXPECT_NEAR(two[k], 0.02 * std::pow(r, n) * (1.0 + n * (1.0 - r)), 1e-15) << k;
  }
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
}  // namespace gyrostat::thermal_lag_test
