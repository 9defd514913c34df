#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/generators/random_error.hpp>
#include <gyrostat/tests/generators/noisy_series.hpp>

namespace gyrostat::grids_test {
namespace {

// Every statistical tolerance here is 5 standard errors of a normal estimate: 6e-7 false failures
// each.

TEST(Quantization, EveryValueIsTheNearestMultipleOfTheLsb) {
  const auto before = noisy(10000, 100.0);
  auto after = before;
  effects::Quantization{.lsb_dps = 0.03}.apply(after, {1, 0});
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(std::remainder(after.gyro_dps[i], 0.03), 0.0, 1e-12);
    EXPECT_LE(std::abs(after.gyro_dps[i] - before.gyro_dps[i]), 0.015 + 1e-12);
  }
}

// The residual e is uniform: the variance of e^2 is lsb^4 / 180, that of a lag product (lsb^2 /
// 12)^2.
TEST(Quantization, LeavesAWhiteResidualOfTheVarianceLsbSquaredOverTwelve) {
  constexpr std::size_t n = 200000;
  constexpr double lsb = 0.04;
  std::vector<double> residual;
  const auto before = noisy(n, 100.0);
  auto after = before;
  effects::Quantization{.lsb_dps = lsb}.apply(after, {1, 0});
  for (std::size_t i = 0; i < n; ++i) residual.push_back(after.gyro_dps[i] - before.gyro_dps[i]);
  EXPECT_NEAR(mean_square(residual), lsb * lsb / 12.0, 5.0 * lsb * lsb / std::sqrt(180.0 * n));
  EXPECT_NEAR(autocovariance(residual, 1), 0.0, 5.0 * lsb * lsb / 12.0 / std::sqrt(n));
}

TEST(AngleQuantization, NeverTakesTheAngleFartherThanAStep) {
  const std::vector<double> t_s = {0.0, 0.3, 5.0, 5.1, 9.0, 40.0};
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    const auto rate = added(effects::AngleQuantization{.coefficient_deg = 0.1}, t_s, trial);
    double angle_deg = 0.0;
    for (std::size_t i = 1; i < t_s.size(); ++i) {
      angle_deg += rate[i] * (t_s[i] - t_s[i - 1]);
      EXPECT_LE(std::abs(angle_deg), std::sqrt(12.0) * 0.1 + 1e-12);
    }
  }
}

// Of white e with E e^4 = 9/5 Q^4 the mean of d_i d_{i + lag}, d_i = e_i - e_{i-1}, is a sum of
// means of e^2 and of products at other lags, which are uncorrelated: n times its variance is 7.2,
// 5.8 and 6 Q^4 at lags 0, 1 and above.
TEST(AngleQuantization, IsCorrelatedWithItsNeighboursAlone) {
  constexpr std::size_t n = 200000;
  const auto rate =
      added(effects::AngleQuantization{.coefficient_deg = 0.003}, even_times(n, 100.0));
  constexpr double unit = 0.3 * 0.3;
  constexpr std::array expected = {2.0, -1.0, 0.0, 0.0};
  constexpr std::array variance = {7.2, 5.8, 6.0, 6.0};
  for (std::size_t lag = 0; lag < expected.size(); ++lag)
    EXPECT_NEAR(autocovariance(rate, lag) / unit, expected[lag], 5.0 * std::sqrt(variance[lag] / n))
        << "lag " << lag;
}

/// Rates are whole numbers of steps an interval, and their errors those of an angle rounded where
/// noise turns it by a step and more (within a part of exp(-2 pi^2), Widrow and Kollar,
/// "Quantization Noise", 2008, 4.3).
TEST(AngleQuantization, OnTheGridRoundsTheAngle) {
  constexpr std::size_t n = 200000;
  auto series = noisy(n, 100.0);
  const NormalStream noise(3, 0, "rate");
  for (std::size_t i = 0; i < n; ++i) series.gyro_dps[i] = 0.7 + 1.5 * noise.normal(i);
  const auto before = series.gyro_dps;
  const double coefficient_deg = 0.01 / std::sqrt(12.0);
  effects::AngleQuantization{coefficient_deg, 1.0}.apply(series, {1, 0});
  std::vector<double> error;
  double angle_deg = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_NEAR(series.gyro_dps[i], std::round(series.gyro_dps[i]), 1e-9) << i;
    error.push_back(series.gyro_dps[i] - before[i]);
    angle_deg += error[i] * 0.01;
    ASSERT_LE(std::abs(angle_deg), 0.01 + 1e-9) << i;
  }
  const double unit = std::pow(coefficient_deg / 0.01, 2);
  EXPECT_NEAR(autocovariance(error, 0) / unit, 2.0, 5.0 * std::sqrt(7.2 / n));
  EXPECT_NEAR(autocovariance(error, 1) / unit, -1.0, 5.0 * std::sqrt(5.8 / n));
  EXPECT_NEAR(autocovariance(error, 2) / unit, 0.0, 5.0 * std::sqrt(6.0 / n));
}

}  // namespace
}  // namespace gyrostat::grids_test
