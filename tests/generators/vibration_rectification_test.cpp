#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/tests/generators/effect_series.hpp>

namespace gyrostat::vibration_rectification_test {
namespace {

/// What vibration of this specific force along z adds, 0.1 s apart, with a time constant of 2 s.
std::vector<double> rectified(const std::vector<double>& acc_z_mps2) {
  auto series = silent(even_times(acc_z_mps2.size(), 10.0));
  series.acc_x_mps2.assign(series.size(), 3.0);
  series.acc_y_mps2.assign(series.size(), 0.0);
  series.acc_z_mps2 = acc_z_mps2;
  effects::VibrationRectification{.coefficient_dps_per_m2ps4 = 0.5, .time_constant_s = 2.0}.apply(
      series, {1, 0});
  return series.gyro_dps;
}

TEST(VibrationRectification, AtRestIsNothing) {
  for (const double bias : rectified(std::vector<double>(100, 9.8))) EXPECT_EQ(bias, 0.0);
}

/// With k = exp(-0.05) from sample to sample the mean of +-A is +-A (1 - k) / (1 + k).
TEST(VibrationRectification, OfAnEvenShakeIsInProportionToItsMeanSquare) {
  std::vector<double> shake;
  for (int i = 0; i < 1000; ++i) shake.push_back(9.8 + (i % 2 == 0 ? 3.0 : -3.0));
  const double k = std::exp(-0.05);
  EXPECT_NEAR(rectified(shake).back(), 0.5 * std::pow(3.0 * 2.0 * k / (1.0 + k), 2), 1e-9);
}

/// After a step A the deviation is A k^i, and its mean square A^2 k^(i + 1) (1 - k^i).
TEST(VibrationRectification, OfAStepIsForgotten) {
  std::vector<double> step(400, 11.8);
  step[0] = 9.8;
  const auto bias = rectified(step);
  const double k = std::exp(-0.05);
  for (int i = 0; i < 400; ++i)
    EXPECT_NEAR(bias[i], 0.5 * 4.0 * std::pow(k, i + 1) * (1.0 - std::pow(k, i)), 1e-12) << i;
}

/// With a mean that forgets by m a sample, which has begun as that of its first time constant, and
/// squares that forget by k, the deviation at the i-th sample of a step A is A m^i and its mean
/// square A^2 m^2 (1 - k) (m^2i - k^i) / (m^2 - k).
TEST(VibrationRectification, OfAStepIsForgottenByBothMeans) {
  auto series = silent(even_times(400, 10.0));
  series.acc_x_mps2.assign(series.size(), 0.0);
  series.acc_y_mps2.assign(series.size(), 0.0);
  series.acc_z_mps2.assign(series.size(), 11.8);
  constexpr int before = 100;
  std::fill_n(series.acc_z_mps2.begin(), before, 9.8);
  effects::VibrationRectification{
      .coefficient_dps_per_m2ps4 = 0.5, .time_constant_s = 0.5, .mean_time_constant_s = 8.0}
      .apply(series, {1, 0});
  const double k = std::exp(-0.2), m = std::exp(-0.0125);
  for (int i = 0; i < 400 - before; ++i)
    EXPECT_NEAR(series.gyro_dps[before - 1 + i],
                0.5 * 4.0 * m * m * (1.0 - k) * (std::pow(m, 2 * i) - std::pow(k, i)) / (m * m - k),
                1e-12)
        << i;
}

/// The bias of ten seconds' shake is centred in time where the mean is, and a time constant later
/// where it looks back alone; both are less what the mean of the vibration takes to settle.
TEST(VibrationRectification, CentredWaitsForNothing) {
  for (const double centred : {0.0, 1.0}) {
    auto series = silent(even_times(1000, 10.0));
    series.acc_x_mps2.assign(series.size(), 0.0);
    series.acc_y_mps2.assign(series.size(), 0.0);
    for (std::size_t i = 0; i < series.size(); ++i)
      series.acc_z_mps2.push_back(9.8 + (i / 100 != 4 ? 0.0 : i % 2 == 0 ? 3.0 : -3.0));
    effects::VibrationRectification{
        .coefficient_dps_per_m2ps4 = 0.5, .time_constant_s = 2.0, .centred = centred}
        .apply(series, {1, 0});
    double sum = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < series.size(); ++i) {
      sum += series.gyro_dps[i];
      moment += series.t_s[i] * series.gyro_dps[i];
    }
    EXPECT_NEAR(moment / sum, 45.0 + (centred > 0.5 ? 0.0 : 2.0), 0.2) << centred;
  }
}

/// Of two stretches, each in proportion to its own mean square from its first sample on.
TEST(VibrationRectification, BetweenItsChangesKeepsToALevel) {
  auto series = silent(even_times(4000, 50.0));
  series.acc_x_mps2.assign(series.size(), 0.0);
  series.acc_y_mps2.assign(series.size(), 0.0);
  const NormalStream noise(5, 0, "shaker");
  for (std::size_t i = 0; i < series.size(); ++i)
    series.acc_z_mps2.push_back(9.8 + (i < 1500 ? 1.0 : 4.0) * noise.normal(i));
  effects::VibrationRectification{0.01, 2.0, 1.0}.apply(series, {1, 0});
  const double before = series.gyro_dps[1480], after = series.gyro_dps[1520];
  EXPECT_NEAR(before, 0.01, 0.01 * 5.0 * std::sqrt(2.0 / 1500.0));
  EXPECT_NEAR(after, 0.16, 0.16 * 5.0 * std::sqrt(2.0 / 2500.0));
  // The first seconds are those of a mean that is not known yet.
  for (std::size_t i = 200; i < 1480; ++i) ASSERT_EQ(series.gyro_dps[i], before) << i;
  for (std::size_t i = 1520; i < series.size(); ++i) ASSERT_EQ(series.gyro_dps[i], after) << i;
}

}  // namespace
}  // namespace gyrostat::vibration_rectification_test
