// What a recording shows of a motion before its reference begins, or after it ends.

#include <gyrostat/diagnosis/known_motion.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/diagnosis/known_heading.hpp>

namespace gyrostat::gap::known_motion_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double rate_hz = 50.0;

/// Five sines, and the angle that they turn.
double turned_at(double t_s, double slope) {
  double sum = 0.0;
  for (int k = 0; k < 5; ++k) {
    const double w = 2.0 * 3.14159265358979 * (0.02 + 0.11 * k), amplitude = 40.0 - 8.0 * k;
    sum += slope * amplitude * std::sin(w * t_s + k) -
           (1.0 - slope) * amplitude / w * std::cos(w * t_s + k);
  }
  return sum;
}
double rate_at(double t_s) { return turned_at(t_s, 1.0); }

Series moving_from_the_first(double late_samples, double heading_late_s, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Series series;
  for (int i = 0; i < 20000; ++i) {
    const double t_s = i / rate_hz;
    series.t_s.push_back(t_s);
    series.gyro_dps.push_back(1.01 * rate_at(t_s - late_samples / rate_hz) + 0.1 +
                              0.05 * normal(engine));
    series.rate_ref_dps.push_back(rate_at(t_s));
    if (heading_late_s >= 0.0)
      series.heading_deg.push_back(
          wrap_degrees(turned_at(t_s - heading_late_s, 0.0) + 0.3 * normal(engine)));
  }
  return series;
}

std::ptrdiff_t missing_in(const std::vector<double>& values) {
  return std::ranges::count_if(values, [](double v) { return is_missing(v); });
}

/// Its deviation is the noise over the root of n times the squared slopes, 0.0002 samples.
TEST(KnownMotion, LatenessIsWhatItIs) {
  for (const double late : {-9.0, -1.3, 0.0, 0.3, 0.925, 2.4, 23.0, 150.0})
    EXPECT_NEAR(lateness_samples(moving_from_the_first(late, -1.0, 20'540)), late, 0.01) << late;
  auto still = moving_from_the_first(0.0, -1.0, 20'541);
  for (double& rate : still.gyro_dps) rate = 0.05 * std::sin(rate);
  EXPECT_EQ(lateness_samples(still), 0.0);
}

TEST(KnownMotion, WhatNobodyKnowsIsMissing) {
  std::vector<std::string> told;
  const auto later = with_known_motion(moving_from_the_first(7.2, -1.0, 20'542), told);
  EXPECT_EQ(missing_in(later.gyro_dps), 9);
  EXPECT_TRUE(is_missing(later.gyro_dps.front()));
  EXPECT_THAT(told, ElementsAre(HasSubstr("7.2 samples later than the reference, which begins")));
  told.clear();
  const auto earlier = with_known_motion(moving_from_the_first(-3.5, -1.0, 20'543), told);
  EXPECT_EQ(missing_in(earlier.gyro_dps), 5);
  EXPECT_TRUE(is_missing(earlier.gyro_dps.back()));
  told.clear();
  const auto heading = with_known_heading(moving_from_the_first(0.0, 0.4, 20'544), told);
  EXPECT_EQ(missing_in(heading.gyro_dps), 0);
  EXPECT_NEAR(static_cast<double>(missing_in(heading.heading_deg)), 8 * 0.4 * rate_hz, 10.0);
  EXPECT_THAT(told, ElementsAre(HasSubstr("s late, and the reference begins in motion")));
  told.clear();
  // At the same time, or from rest, all of it is known.
  EXPECT_EQ(missing_in(with_known_motion(moving_from_the_first(0.0, 0.0, 20'545), told).gyro_dps),
            0);
  EXPECT_EQ(
      missing_in(with_known_heading(moving_from_the_first(0.0, 0.0, 20'545), told).heading_deg), 0);
  auto from_rest = moving_from_the_first(0.0, -1.0, 20'546);
  for (std::size_t i = 0; i < from_rest.size(); ++i) {
    const double soft = std::min(1.0, 1e-3 * static_cast<double>(i));
    from_rest.gyro_dps[i] *= std::min(1.0, 1e-3 * static_cast<double>(i > 6 ? i - 6 : 0));
    from_rest.rate_ref_dps[i] *= soft;
  }
  EXPECT_EQ(missing_in(with_known_motion(from_rest, told).gyro_dps), 0);
  EXPECT_THAT(told, IsEmpty());
}

/// Under one rate all the time, but for its noise, a lag is not to be told from where the heading
/// began: what passes for one is as long as noise of the heading makes it.
TEST(KnownHeading, OfATableAtOneRateIsAllThere) {
  for (const std::uint64_t seed : {20'548, 20'549, 20'550, 20'551}) {
    auto series = moving_from_the_first(0.0, 0.0, seed);
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < series.size(); ++i) {
      series.rate_ref_dps[i] = 40.0 + 0.01 * normal(engine);
      series.heading_deg[i] = wrap_degrees(40.0 * series.t_s[i] + 0.3 * normal(engine));
    }
    std::vector<std::string> told;
    EXPECT_EQ(missing_in(with_known_heading(series, told).heading_deg), 0) << seed;
  }
}

/// A simulator that evaluates its motion at another time: it was a bias that steps, beside a p of
/// 1e-47.
TEST(KnownMotion, AShiftedMotionIsThatAlone) {
  std::vector<std::string> told;
  const auto found =
      diagnose(with_known_motion(moving_from_the_first(23.0, -1.0, 20'547), told), {});
  std::vector<std::string> names;
  for (const auto& effect : found.enriched.effects) names.emplace_back(effect.id());
  std::ranges::sort(names);
  EXPECT_THAT(names, ElementsAre("scale_factor", "time_offset"));
  EXPECT_GT(found.p_after, 1e-3);
}

}  // namespace
}  // namespace gyrostat::gap::known_motion_test
