// Sensors that are slower than their recorder.

#include <gyrostat/diagnosis/likelihood/slower_clock.hpp>

#include <cmath>
#include <random>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/diagnosis/own_clock.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/found_in.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::slower_clock_test {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

constexpr double rate_hz = 25.0, white_dps = 0.05;

/// What a sensor of its own clock shows, as a recorder writes it `ratio` times as often: white
/// noise and a walk about a rate that is a function of time, rounded to a grid or not.
template <class Rate>
Series held(double ratio, double grid_dps, std::uint64_t seed, const Rate& rate_dps,
            std::size_t samples = 15000) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Series series;
  double walk_dps = 0.1, value = 0.0, next = 0.0, number = 0.0;
  for (std::size_t i = 0; i < samples; ++i) {
    const double at = static_cast<double>(i);
    for (; next <= at + 1e-9; next = ratio * ++number) {
      walk_dps += 2e-4 * normal(engine);
      value = rate_dps(next / rate_hz) + walk_dps + white_dps * normal(engine);
      if (grid_dps > 0.0) value = grid_dps * std::round(value / grid_dps);
    }
    series.t_s.push_back(at / rate_hz);
    series.gyro_dps.push_back(value);
  }
  return series;
}
constexpr auto at_rest = [](double) { return 0.0; };
constexpr auto turning_dps = [](double t_s) {
  return 40.0 * std::sin(0.13 * t_s) + 25.0 * std::sin(0.41 * t_s + 1.0) +
         15.0 * std::sin(1.3 * t_s + 2.0);
};

Series with_reference(Series series) {
  for (const double t_s : series.t_s) series.rate_ref_dps.push_back(turning_dps(t_s));
  return series;
}

/// A grid of more than the noise makes a third of all neighbours equal by chance.
TEST(SlowerClock, ItsRatioIsReadThroughAnyGrid) {
  for (const double grid_dps : {0.0, 0.0076, 0.061})
    for (const double ratio : {1.25, 1.3, 1.7, 2.0, 2.5, 3.0, 5.0, 7.31}) {
      const auto series = held(ratio, grid_dps, 20'500, at_rest);
      const auto clock = slower_clock(Conditions(series), series.gyro_dps);
      ASSERT_TRUE(clock) << ratio << " on " << grid_dps;
      EXPECT_NEAR(clock->samples, ratio, 1e-4 * ratio) << "on " << grid_dps;
      if (ratio == std::round(ratio)) {
        EXPECT_EQ(clock->samples, ratio);
      }
    }
}

TEST(SlowerClock, RepeatsByChanceGridsAndMotionsAreNone) {
  const auto none_in = [](const Series& series) {
    return !slower_clock(Conditions(series), series.gyro_dps);
  };
  EXPECT_TRUE(none_in(held(1.0, 0.0, 20'501, at_rest)));
  EXPECT_TRUE(none_in(held(1.0, 0.1, 20'501, at_rest)));
  auto by_chance = held(1.0, 0.0, 20'502, at_rest);
  effects::StaleSamples{0.3, 1.5}.apply(by_chance, {1, 0});
  EXPECT_TRUE(none_in(by_chance));
  // A ramp without noise goes from step to step of a grid as evenly as a clock does.
  auto ramp = held(1.0, 0.0, 20'503, at_rest);
  for (std::size_t i = 0; i < ramp.size(); ++i)
    ramp.gyro_dps[i] = 0.01 * std::round(0.004 * static_cast<double>(i) / 0.01);
  EXPECT_TRUE(none_in(ramp));
}

/// What half the values, a third and so on say of a spectrum is said again above it, and no line or
/// noise is to stand for that: before, one stood beside most. At 4 % for each recording, as without
/// a clock, three of twelve have one in one family of a hundred.
TEST(SlowerClock, NothingElseIsFoundBesideIt) {
  const std::set<std::string> repeats{"stale_samples"}, on_grid{"quantization", "stale_samples"};
  int alone = 0;
  for (const double ratio : {1.3, 2.0, 3.0})
    for (const std::uint64_t seed : {20'510, 20'511}) {
      alone += found_in(held(ratio, 0.0, seed, at_rest)) == repeats ? 1 : 0;
      alone += found_in(held(ratio, 0.061, seed, at_rest)) == on_grid ? 1 : 0;
    }
  EXPECT_GE(alone, 10);
}

TEST(SlowerClock, WhatIsThereIsFoundBesideIt) {
  for (const double ratio : {2.0, 4.0}) {
    EXPECT_EQ(found_in(held(ratio, 0.0, 20'520,
                            [](double t_s) { return 0.03 * std::sin(2.0 * 3.14159 * 1.7 * t_s); })),
              (std::set<std::string>{"sinusoidal", "stale_samples"}))
        << ratio;
    auto hit = held(ratio, 0.0, 20'521, at_rest);
    std::mt19937_64 engine(20'522);
    const auto fresh = hit.gyro_dps;
    for (std::size_t i = 1; i < hit.size(); ++i)
      if (fresh[i] == fresh[i - 1])
        hit.gyro_dps[i] = hit.gyro_dps[i - 1];
      else if (std::bernoulli_distribution(0.01)(engine))
        hit.gyro_dps[i] += std::normal_distribution(0.0, 0.5)(engine);
    EXPECT_EQ(found_in(hit), (std::set<std::string>{"outliers", "stale_samples"})) << ratio;
  }
}

/// Values are up to a sample old while the rate changes by up to 40 dps a second: by 0.9 dps.
TEST(SlowerClock, OfATableValuesAreMovedToTheirTimes) {
  std::vector<std::string> told;
  const auto series = with_reference(held(2.618034, 0.0, 20'530, turning_dps));
  const auto moved = at_the_recorders_times(series, told);
  EXPECT_THAT(told, SizeIs(1));
  EXPECT_THAT(told.front(), HasSubstr("each 2.618 samples"));
  double squares = 0.0, count = 0.0;
  for (std::size_t i = 1; i < moved.size(); ++i) {
    EXPECT_EQ(moved.gyro_dps[i] == moved.gyro_dps[i - 1],
              series.gyro_dps[i] == series.gyro_dps[i - 1]);
    if (series.gyro_dps[i] == series.gyro_dps[i - 1]) continue;
    const double off = moved.gyro_dps[i] - moved.rate_ref_dps[i] - 0.1;
    squares += off * off;
    count += 1.0;
  }
  // The walk adds less than as much again.
  EXPECT_LT(std::sqrt(squares / count), 2.0 * white_dps);
  EXPECT_EQ(found_in(moved), (std::set<std::string>{"stale_samples"}));
  // Of a whole number all are equally old, which is a shift.
  told.clear();
  const auto even = with_reference(held(2.0, 0.0, 20'531, turning_dps));
  EXPECT_EQ(at_the_recorders_times(even, told).gyro_dps, even.gyro_dps);
  EXPECT_THAT(told, SizeIs(0));
}

}  // namespace
}  // namespace gyrostat::gap::slower_clock_test
