#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/diagnosis/gap/between_steps.hpp>
#include <gyrostat/diagnosis/gap/local_trend.hpp>

namespace gyrostat::thermometer_test {
namespace {

using gap::between_steps;
using gap::slopes_in_noise;

struct Curve {
  std::vector<double> times, values, slopes;
};

/// Warming up by 12 degrees with a time constant of 300 s, every 0.4 s for 20 minutes.
Curve warming_up() {
  Curve curve;
  for (int i = 0; i < 3000; ++i) {
    const double t = 0.4 * i, left = std::exp(-t / 300.0);
    curve.times.push_back(t);
    curve.values.push_back(25.0 + 12.0 * (1.0 - left));
    curve.slopes.push_back(12.0 / 300.0 * left);
  }
  return curve;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

std::vector<double> rounded(std::vector<double> values, double step) {
  for (double& value : values) value = step * std::round(value / step);
  return values;
}

TEST(SlopesInNoise, OfAStraightLineAreItsSlope) {
  const auto slopes = slopes_in_noise({0.0, 1.0, 2.5, 3.0, 7.0}, {1.0, 3.0, 6.0, 7.0, 15.0});
  for (const double slope : slopes) EXPECT_NEAR(slope, 2.0, 1e-13);
}

/// Half an interval of the bend at the ends.
TEST(SlopesInNoise, WithoutNoiseAreThoseBetweenNeighbours) {
  const auto curve = warming_up();
  const double bend = curve.slopes[0] / 300.0;
  EXPECT_NEAR(largest_difference(slopes_in_noise(curve.times, curve.values), curve.slopes),
              0.5 * 0.4 * bend, 1e-7);
}

/// From a span of w values an unbiased slope has an error of sqrt(12 / w^3) / 0.4 noises, at its
/// end twice as much, and a span of h seconds errs by half of h bends at an end. The best span for
/// an end is 10 s, with 0.0007 of bias and 0.0006 of noise; five of the latter are allowed, with
/// 6e-7 false failures. Neighbours tell slopes of 0.04 to 0.008 alone.
TEST(SlopesInNoise, AreKnownFromAsLongASpanAsIsNearlyStraight) {
  const auto curve = warming_up();
  auto seen = curve.values;
  const NormalStream noise(1, 0, "thermometer");
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] += 0.0045 * noise.normal(i);
  EXPECT_LT(largest_difference(slopes_in_noise(curve.times, seen), curve.slopes),
            0.0007 + 5.0 * 0.0006);
}

TEST(SlopesInNoise, OfFewerThanThreeValuesAreZero) {
  EXPECT_EQ(slopes_in_noise({0.0, 1.0}, {0.0, 1.0}), std::vector<double>(2, 0.0));
}

/// Rounding errs by half a step of 0.1 degrees. Crossings are 2.5 s apart at first and 130 s at the
/// end, where the curve bends away from its chord by 0.0055 degrees and the last run goes on from
/// the one before it.
TEST(BetweenSteps, ARoundedCurveIsKnownToAFractionOfItsSteps) {
  const auto curve = warming_up();
  const auto steps = rounded(curve.values, 0.1);
  ASSERT_GT(largest_difference(steps, curve.values), 0.049);
  const auto drawn = between_steps(steps, 1e-6);
  for (std::size_t i = 0; i < drawn.size(); ++i) EXPECT_NEAR(drawn[i], curve.values[i], 0.012) << i;
}

TEST(BetweenSteps, AStraightRampIsGivenBack) {
  std::vector<double> ramp;
  for (int i = 0; i < 100; ++i) ramp.push_back(0.1 * i + 0.05);
  const auto drawn = between_steps(rounded(ramp, 1.0), 1e-6);
  EXPECT_LT(largest_difference(drawn, ramp), 1e-12);
}

TEST(BetweenSteps, WhatNeverRepeatsIsAsItWas) {
  std::vector<double> noisy;
  const NormalStream noise(2, 0, "thermometer");
  for (std::size_t i = 0; i < 100; ++i) noisy.push_back(25.0 + noise.normal(i));
  EXPECT_EQ(between_steps(noisy, 1e-6), noisy);
}

TEST(BetweenSteps, AConstantAndARunThatTurnsKeepTheirValues) {
  const std::vector<double> constant(20, 25.0), up_and_down{1.0, 1.0, 2.0, 2.0, 2.0, 1.0, 1.0};
  EXPECT_EQ(between_steps(constant, 1e-6), constant);
  const auto drawn = between_steps(up_and_down, 1e-6);
  for (std::size_t i = 2; i < 5; ++i) EXPECT_EQ(drawn[i], 2.0);
}

TEST(BetweenSteps, TheLastDigitsOfNumbersAreNoSteps) {
  const std::vector<double> settled{40.0 - 2e-14, 40.0 - 2e-14, 40.0 - 1e-14,
                                    40.0 - 1e-14, 40.0,         40.0};
  EXPECT_EQ(between_steps(settled, 1e-6), settled);
}

}  // namespace
}  // namespace gyrostat::thermometer_test
