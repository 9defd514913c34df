#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/statistics/summary.hpp"
#include "core/random.hpp"

namespace gyrostat {
namespace {

TEST(Summary, IsWhatOneComputesByHand) {
  const std::vector<double> values = {1.0, -2.0, 3.0, 4.0, -10.0};
  const auto s = summarise(values);
  EXPECT_EQ(s.count, 5U);
  EXPECT_EQ(s.missing, 0U);
  EXPECT_DOUBLE_EQ(s.mean, -0.8);
  // Squared deviations 3.24 + 1.44 + 14.44 + 23.04 + 84.64 = 126.8, over 4.
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(31.7));
  EXPECT_NEAR(s.half_width_95, 2.7764451 * std::sqrt(31.7 / 5.0), 1e-6);
  EXPECT_DOUBLE_EQ(s.median, 1.0);
  EXPECT_DOUBLE_EQ(s.worst, 10.0);
  // |v| sorted: 1 2 3 4 10; type 7 at 0.95: position 3.8 between 4 and 10.
  EXPECT_DOUBLE_EQ(s.percentile_95, 8.8);
}

TEST(Summary, TheMedianOfAnEvenCountIsTheMiddleOfTheMiddleTwo) {
  EXPECT_DOUBLE_EQ(summarise(std::array{4.0, 1.0, 3.0, 2.0}).median, 2.5);
}

TEST(Summary, MissingValuesAreCountedAndLeftOut) {
  const auto with = summarise(std::array{1.0, no_value, 2.0, no_value, 4.0});
  const auto without = summarise(std::array{1.0, 2.0, 4.0});
  EXPECT_EQ(with.count, 3U);
  EXPECT_EQ(with.missing, 2U);
  EXPECT_EQ(with.mean, without.mean);
  EXPECT_EQ(with.std, without.std);
  EXPECT_EQ(with.half_width_95, without.half_width_95);
  EXPECT_EQ(with.percentile_95, without.percentile_95);
}

TEST(Summary, OfNothingHasNoNumbers) {
  for (const auto& s : {summarise({}), summarise(std::array{no_value, no_value})}) {
    EXPECT_EQ(s.count, 0U);
    for (const double v : {s.mean, s.half_width_95, s.std, s.median, s.percentile_95, s.worst})
      EXPECT_TRUE(std::isnan(v));
  }
}

TEST(Summary, OfOneValueHasNoSpread) {
  const auto s = summarise(std::array{-3.0});
  EXPECT_EQ(s.mean, -3.0);
  EXPECT_EQ(s.median, -3.0);
  EXPECT_EQ(s.worst, 3.0);
  EXPECT_TRUE(std::isnan(s.std));
  EXPECT_TRUE(std::isnan(s.half_width_95));
}

TEST(Summary, MovesAndScalesWithItsValues) {
  std::vector<double> values(200), moved;
  NormalStream(1, 0, "summary").fill(0, values);
  for (const double v : values) moved.push_back(1e3 + 2.0 * v);
  const auto a = summarise(values), b = summarise(moved);
  EXPECT_NEAR(b.mean, 1e3 + 2.0 * a.mean, 1e-10);
  EXPECT_NEAR(b.std, 2.0 * a.std, 1e-10);
  EXPECT_NEAR(b.half_width_95, 2.0 * a.half_width_95, 1e-10);
  EXPECT_NEAR(b.median, 1e3 + 2.0 * a.median, 1e-10);
}

TEST(Summary, DoesNotDependOnTheOrder) {
  std::vector<double> values(200);
  NormalStream(1, 0, "summary").fill(0, values);
  const auto a = summarise(values);
  std::reverse(values.begin(), values.end());
  const auto b = summarise(values);
  EXPECT_NEAR(a.mean, b.mean, 1e-15);
  EXPECT_NEAR(a.std, b.std, 1e-15);
  EXPECT_EQ(a.median, b.median);
  EXPECT_EQ(a.percentile_95, b.percentile_95);
  EXPECT_EQ(a.worst, b.worst);
}

/// Abramowitz and Stegun (1964), table 26.10, two-sided.
TEST(StudentT, QuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(student_t_quantile(0.95, 1), 12.706, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.95, 2), 4.303, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.95, 10), 2.228, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.95, 30), 2.042, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.95, 120), 1.980, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.99, 5), 4.032, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.95, 1e9), 1.959964, 1e-6);
}

/// One degree of freedom is Cauchy's distribution, two have a closed form too.
TEST(StudentT, QuantilesOfOneAndTwoDegreesAreAnalytic) {
  for (const double confidence : {0.5, 0.9, 0.95, 0.99}) {
    EXPECT_NEAR(student_t_quantile(confidence, 1), std::tan(0.5 * std::numbers::pi * confidence),
                1e-9);
    EXPECT_NEAR(student_t_quantile(confidence, 2),
                confidence * std::sqrt(2.0 / (1.0 - confidence * confidence)), 1e-10);
  }
}

// Covered or not is binomial with p = 0.95; at 5 standard errors each check fails falsely at 6e-7.
TEST(Summary, TheIntervalOfTheMeanCoversTheTruthInNineteenOfTwentySamples) {
  constexpr std::uint32_t replicas = 20000;
  for (const std::size_t size : {2, 5, 30}) {
    std::vector<double> values(size);
    double covered = 0.0;
    for (std::uint32_t trial = 0; trial < replicas; ++trial) {
      NormalStream(11, trial, "coverage").fill(64 * size, values);
      const auto s = summarise(values);
      covered += std::abs(s.mean) <= s.half_width_95;
    }
    EXPECT_NEAR(covered / replicas, 0.95, 5.0 * std::sqrt(0.95 * 0.05 / replicas)) << size;
  }
}

}  // namespace
}  // namespace gyrostat
