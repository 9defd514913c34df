#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/diagnosis/reference_noise.hpp>
#include <gyrostat/tests/diagnosis/found_in.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::reference_noise_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double rate_hz = 50.0;
constexpr std::size_t samples = 30000;

/// A sine of 0.2 Hz, and a plateau from the tenth minute's middle on.
double turned_dps(double t_s) {
  return t_s > 570.0 ? 12.0 : 40.0 * std::sin(2.0 * std::numbers::pi * 0.2 * t_s);
}

/// A gyro of white noise of 0.05 dps beside a reference that has `noise_dps` of its own, while the
/// sensor is shaken by `shake_dps` of white noise.
Series turning(double noise_dps, double shake_dps = 0.0) {
  const NormalStream gyro(1, 0, "gyro"), reference(1, 0, "reference"), shake(1, 0, "shake");
  Series series;
  for (std::size_t i = 0; i < samples; ++i) {
    series.t_s.push_back(static_cast<double>(i) / rate_hz);
    const double rate = turned_dps(series.t_s[i]) + shake_dps * shake.normal(i);
    series.rate_ref_dps.push_back(rate + noise_dps * reference.normal(i));
    series.gyro_dps.push_back(rate + 0.05 * gyro.normal(i));
  }
  return series;
}

/// Sixth differences of white noise are worth a third as many independent ones: of 30,000 they tell
/// a deviation within 0.7 %; five such errors, 6e-7 false failures.
TEST(ReferenceNoise, IsToldFromAMotion) {
  EXPECT_NEAR(reference_noise_dps(turning(0.02)), 0.02, 0.02 * 0.035);
}

TEST(ReferenceNoise, IsNotWhereTheReferenceHasNoneOrTheGyroFollowsIt) {
  EXPECT_EQ(reference_noise_dps(turning(0.0)), 0.0);
  EXPECT_EQ(reference_noise_dps(turning(0.0, 0.02)), 0.0);
}

/// As a motion capture's rates, which are differences of smoothed angles.
TEST(ReferenceNoise, OfMemoryIsNotTold) {
  auto series = turning(0.02);
  const auto noisy = series.rate_ref_dps;
  for (std::size_t i = 1; i + 1 < samples; ++i)
    series.rate_ref_dps[i] = (noisy[i - 1] + noisy[i] + noisy[i + 1]) / 3.0;
  EXPECT_EQ(reference_noise_dps(series), 0.0);
}

/// On the plateau, parabolas over 111 samples leave a seventh of the noise; beside its jump there
/// is no such span.
TEST(WithoutWhiteNoise, LevelsAreQuietAndJumpsStay) {
  const auto series = turning(0.02);
  const auto smooth = without_white_noise(series.rate_ref_dps, 0.02);
  double square = 0.0, count = 0.0;
  for (std::size_t i = 28600; i < samples - 100; ++i, count += 1.0)
    square += std::pow(smooth[i] - 12.0, 2);
  EXPECT_LT(std::sqrt(square / count), 0.02 / 4.0);
  for (std::size_t i = 28000; i < samples; ++i)
    ASSERT_NEAR(smooth[i], turned_dps(series.t_s[i]), 5.0 * 0.02) << i;
}

/// At its fastest, the sine of 0.2 Hz is a parabola over 17 samples, which leave a third of the
/// noise; where shorter spans disagree by chance, more is left.
TEST(WithoutWhiteNoise, AMotionStaysAsItIs) {
  const auto series = turning(0.02);
  const auto smooth = without_white_noise(series.rate_ref_dps, 0.02);
  double square = 0.0;
  for (std::size_t i = 0; i < 28000; ++i)
    square += std::pow(smooth[i] - turned_dps(series.t_s[i]), 2);
  EXPECT_LT(std::sqrt(square / 28000.0), 0.02 * 2.0 / 3.0);
}

TEST(WithoutReferenceNoise, TheGyrosErrorIsWhatItWas) {
  const auto series = turning(0.02);
  std::vector<std::string> told;
  const auto without = without_reference_noise(series, told);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told.front(), HasSubstr("the reference rate has white noise"));
  for (std::size_t i = 0; i < samples; ++i)
    ASSERT_NEAR(without.gyro_dps[i] - without.rate_ref_dps[i],
                series.gyro_dps[i] - series.rate_ref_dps[i], 1e-12);
}

TEST(WithoutReferenceNoise, AGridStays) {
  auto series = turning(0.02);
  for (double& value : series.gyro_dps) value = 0.05 * std::round(value / 0.05);
  std::vector<std::string> told;
  const auto without = without_reference_noise(series, told);
  EXPECT_THAT(told, Not(IsEmpty()));
  EXPECT_EQ(without.gyro_dps, series.gyro_dps);
}

TEST(WithoutReferenceNoise, WhereThereIsNoneNothingChanges) {
  const auto series = turning(0.0);
  std::vector<std::string> told;
  EXPECT_EQ(without_reference_noise(series, told).rate_ref_dps, series.rate_ref_dps);
  EXPECT_THAT(told, IsEmpty());
}

/// Against the noisy reference itself each of these four gyros has a bandwidth.
/// Names by chance stand in 4 % of recordings, two of four in one set of a hundred.
TEST(WithoutReferenceNoise, GoodGyrosHaveNothing) {
  int named = 0;
  for (const std::uint32_t seed : {41u, 42u, 43u, 44u}) {
    auto series = recorded(moving(ten_minutes_s), seed, true);
    series.heading_deg.clear();
    const NormalStream noise(seed, 0, "reference");
    for (std::size_t i = 0; i < series.size(); ++i)
      series.rate_ref_dps[i] += 0.03 * noise.normal(i);
    std::vector<std::string> told;
    named += found_in(without_reference_noise(series, told)).empty() ? 0 : 1;
    EXPECT_EQ(told.size(), 1u);
  }
  EXPECT_LE(named, 1);
}

}  // namespace
}  // namespace gyrostat::gap::reference_noise_test
