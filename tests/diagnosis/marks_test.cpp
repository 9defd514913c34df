// What the values of a recording show before anything is fitted.

#include <gyrostat/diagnosis/likelihood/marks.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/diagnosis/likelihood/set_search.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::marks_test {
namespace {

/// A hundred turns of a table in 20 minutes, rounded to about the noise.
Scenario turning_on_a_grid() {
  Scenario s = still();
  s.motion = motion::RateTable{60.0, 24.0};
  s.effects = {effects::Quantization{0.04}};
  return s;
}

/// At rest, and turned by a rate that is a function of time.
template <class Rate>
Series turned(std::uint64_t seed, const Rate& rate_dps) {
  Series series = recorded(still(twenty_minutes_s), seed, false);
  for (const double t_s : series.t_s) series.rate_ref_dps.push_back(rate_dps(t_s));
  for (std::size_t i = 0; i < series.size(); ++i) series.gyro_dps[i] += series.rate_ref_dps[i];
  return series;
}

Marks marks_in(const Series& series) { return marks_of(Simulator(series, 1), series); }

/// At rest every fifth sample equals the one before by chance; across a turn none does. Of the 199
/// turns of each recording one in eleven is repeated, of all of them with a standard error of
/// 0.6 %; four of these are allowed.
TEST(Marks, RepeatsBesideAGridShowWhereTheMotionTurns) {
  Scenario s = turning_on_a_grid();
  double share = 0.0;
  constexpr int recordings = 12;
  for (std::uint64_t seed = 40; seed < 40 + recordings; ++seed) {
    EXPECT_EQ(marks_in(recorded(s, seed, true)).stale_probability, 0.0);
    Scenario stale = s;
    stale.effects.emplace_back(effects::StaleSamples{0.1, 1.0});
    const auto marks = marks_in(recorded(stale, seed, true));
    EXPECT_NEAR(marks.lsb_dps, 0.04, 1e-9);
    const double repeats_of_a_fresh_one = marks.stale_probability * marks.stale_run;
    share += repeats_of_a_fresh_one / (1.0 + repeats_of_a_fresh_one) / recordings;
  }
  EXPECT_NEAR(share, 1.0 / 11.0, 0.024);
}

/// Without a grid each repeat shows, and 199 turns say less than all the 12,000 samples that are
/// read: of those the chance is known to 0.0021. Four times that is allowed.
TEST(Marks, RepeatsWithoutAGridAreCountedEverywhere) {
  Scenario s = turning_on_a_grid();
  s.effects = {effects::StaleSamples{0.05, 1.0}};
  EXPECT_NEAR(marks_in(recorded(s, 40, true)).stale_probability, 0.05, 0.0084);
}

/// One sample, of a hundred turns, is off by all of a turn: a filter and telegraph noise of 4 dps,
/// or white noise of 0.5 dps, stood in for it, whichever half it is in.
TEST(Marks, ARepeatShowsWhereverTheMotionTurns) {
  for (const Part part : both_parts) {
    auto series = recorded(turning_on_a_grid(), 40, true);
    const Conditions conditions(series);
    const auto& spans = conditions.spans(part);
    const auto& span = spans[spans.size() / 2];
    for (std::size_t i = span.first + span.size() / 4; i < span.last; ++i)
      if (series.rate_ref_dps[i] != series.rate_ref_dps[i - 1]) {
        series.gyro_dps[i] = series.gyro_dps[i - 1];
        break;
      }
    EXPECT_GT(marks_in(series).stale_probability, 0.0) << index_of(part);
  }
}

/// A table that ramps from rest to rest, rounded to three standard deviations of the noise: between
/// ramps neighbours are equal as often as the rate lies near a value, and within them steps of
/// little more than the grid's are undone by noise.
TEST(Marks, WhatRestsOnACoarseGridIsNoRepeat) {
  constexpr double lsb_dps = 0.15, period_s = 30.0, ramp_s = 2.5;
  for (std::uint64_t seed = 60; seed < 66; ++seed) {
    Series series = turned(seed, [&](double t_s) {
      const double periods = std::floor(t_s / period_s);
      const double into_s = t_s - periods * period_s;
      const auto rest_dps = [&](double number) { return 9.0 * std::sin(2.0 * number); };
      const double from = rest_dps(periods), to = rest_dps(periods + 1.0);
      return from + (to - from) * std::min(into_s / ramp_s, 1.0);
    });
    for (double& z : series.gyro_dps) z = lsb_dps * std::nearbyint(z / lsb_dps);
    EXPECT_EQ(marks_in(series).stale_probability, 0.0) << seed;
  }
}

/// A converter clips at both ends, of which a bias taken out afterwards makes two limits; an end
/// that is not reached is none.
TEST(Marks, BothLimitsAreReadOff) {
  Scenario s = moving();
  s.effects = {effects::Saturation{.limit_dps = 50.0, .below_dps = 70.0}};
  auto marks = marks_in(recorded(s, 42, true));
  EXPECT_EQ(marks.limit_dps, 50.0);
  EXPECT_EQ(marks.below_dps, 70.0);
  s.effects = {effects::Saturation{.limit_dps = 50.0, .below_dps = 200.0}};
  marks = marks_in(recorded(s, 42, true));
  EXPECT_EQ(marks.limit_dps, 50.0);
  EXPECT_GT(marks.below_dps, 79.0);
  s.effects = {effects::Saturation{.limit_dps = 50.0}};
  EXPECT_EQ(marks_in(recorded(s, 42, true)).below_dps, 0.0);
}

/// A gyro that lags its reference by a sample stands still where the reference turns, and equals by
/// chance.
TEST(Marks, AGyroThatLagsRepeatsNothing) {
  Series series = recorded(turning_on_a_grid(), 41, true);
  series.gyro_dps.insert(series.gyro_dps.begin(), series.gyro_dps.front());
  series.gyro_dps.pop_back();
  EXPECT_EQ(marks_in(series).stale_probability, 0.0);
}

/// A zone that holds the output at rest is no wider than half of the fastest rate: what is still at
/// rest where the table turns already is repeated.
TEST(Marks, ARestThatIsReadBesideAFastTurnIsRepeated) {
  Scenario s = turning_on_a_grid();
  s.motion = motion::RateTable{60.0, 24.0};
  Series series = recorded(s, 47, true);
  std::vector<std::size_t> repeated;
  for (std::size_t i = 1; i < series.size(); ++i)
    if (series.rate_ref_dps[i - 1] == 0.0 && std::abs(series.rate_ref_dps[i]) > 30.0) {
      series.gyro_dps[i] = series.gyro_dps[i - 1];
      repeated.push_back(i);
    }
  const auto marks = marks_in(series);
  ASSERT_GT(marks.stale_probability, 0.0);
  for (const std::size_t i : repeated) EXPECT_TRUE(marks.repeats[i]) << i;
}

/// Ramps of 60 dps and rests; the sensor follows with a pole of eight samples. At the start of a
/// ramp it has not moved yet, and equals by chance; repeated it is only where it moves.
TEST(Marks, AFilterThatHasNotBegunToMoveRepeatsNothing) {
  for (const double probability : {0.0, 0.05}) {
    Series series = recorded(still(), 43, false);
    double rate_dps = 0.0, seen_dps = 0.0;
    for (std::size_t i = 0; i < series.size(); ++i) {
      const std::size_t ramp = i / 400;
      if (i % 400 < 100) rate_dps += ramp % 2 == 0 ? 0.6 : -0.6;
      seen_dps += (rate_dps - seen_dps) * -std::expm1(-1.0 / 8.0);
      series.rate_ref_dps.push_back(rate_dps);
      series.gyro_dps[i] += seen_dps;
    }
    effects::Quantization{0.07}.apply(series, {1, 0});
    effects::StaleSamples{probability, 1.0}.apply(series, {1, 0});
    // 18000 samples of the part that is read: 5 standard errors.
    EXPECT_NEAR(marks_in(series).stale_probability, probability,
                5.0 * std::sqrt(probability / (0.25 * 18000.0)));
  }
}

/// A bias that was taken out after the converter moves the grid.
TEST(Marks, AGridMayBeOffZero) {
  for (const double offset_dps : {0.0, 0.03, -0.05}) {
    Series series = recorded(still(), 45, false);
    effects::Quantization{0.12, offset_dps}.apply(series, {1, 0});
    EXPECT_NEAR(marks_in(series).lsb_dps, 0.12, 1e-9);
    EXPECT_NEAR(marks_in(series).grid_offset_dps, offset_dps, 1e-6) << offset_dps;
  }
}

/// A firmware that takes a slow bias out of rounded rates moves their grid by a millionth of a
/// step: neighbours that are equal are so by chance.
TEST(Marks, AGridThatIsMovedSlowlyMakesNoRepeats) {
  Series series = recorded(still(twenty_minutes_s), 43, false);
  effects::Quantization{0.06}.apply(series, {1, 0});
  for (std::size_t i = 0; i < series.size(); ++i)
    series.gyro_dps[i] += 1e-6 * std::nearbyint(2e3 * std::sin(2e-3 * series.t_s[i]));
  EXPECT_EQ(marks_in(series).stale_probability, 0.0);
  effects::StaleSamples{0.1, 1.0}.apply(series, {1, 0});
  EXPECT_GT(marks_in(series).stale_probability, 0.03);  // not all of them are told from chance
}

/// Each sample is the one before with a chance of 0.15, whatever that was: of the repeats as many
/// follow a repeat, and where a fresh one follows each, none.
TEST(Marks, RepeatsMayFollowOneAnother) {
  constexpr double share = 0.15;
  Series series = recorded(moving(), 44, true), even = series;
  const NormalStream chance(44, 0, "chance");
  for (std::size_t i = 1; i < series.size(); ++i)
    if (chance.uniform(i) < share) series.gyro_dps[i] = series.gyro_dps[i - 1];
  const auto marks = marks_in(series);
  // 18000 samples of the part that is read, 2700 of them repeats: 5 standard errors.
  EXPECT_NEAR(marks.stale_run, 1.0 / (1.0 - share),
              5.0 * std::sqrt(share / 2700.0) / std::pow(1.0 - share, 1.5));
  const double repeated = marks.stale_probability * marks.stale_run;
  EXPECT_NEAR(repeated / (1.0 + repeated), share, 5.0 * std::sqrt(share / 18000.0));
  effects::StaleSamples{share, 1.0}.apply(even, {1, 0});
  EXPECT_LT(marks_in(even).stale_run, 1.01);
}

/// Where a motion is slow a grid makes neighbours equal, in rows: how long repeats last shows where
/// it is fast. None of some 500 is followed by another: were one in a hundred, it were 1 in 150.
TEST(Marks, NeighboursThatAGridMakesEqualAreNoLongerRepeats) {
  const auto slow_and_fast = [](double t_s) { return 60.0 * std::sin(0.5 * t_s); };
  auto series = turned(70, slow_and_fast);
  constexpr double lsb_dps = 0.1;
  for (double& z : series.gyro_dps) z = lsb_dps * std::nearbyint(z / lsb_dps);
  const auto fresh = series.gyro_dps;
  const NormalStream stream(1, 0, "stale");
  std::size_t last = 0;
  for (std::size_t i = 2; i < fresh.size(); ++i)
    if (stream.uniform(i) < 0.05 && last + 1 < i) series.gyro_dps[i] = fresh[(last = i) - 1];
  const auto marks = marks_in(series);
  EXPECT_GT(marks.stale_probability, 0.04);
  EXPECT_LT(marks.stale_run, 1.02);
}

/// A buffer of two places whose other one is sent: outliers and lines stood in for these.
TEST(Marks, AnOlderValueThanTheLastIsARepeat) {
  Scenario s = still();
  s.effects = {effects::StaleSamples{.probability = 0.02, .back = 2.0}};
  const auto series = recorded(s, 45, false);
  const auto marks = marks_in(series);
  EXPECT_EQ(marks.stale_back, 2);
  EXPECT_NEAR(marks.stale_probability, 0.02, 5.0 * std::sqrt(0.02 / 18000.0));
  const Simulator simulator(series, 1);
  const auto found = find_set(simulator, series, {});
  ASSERT_EQ(found.members.size(), 1);
  EXPECT_EQ(found.members[0].effect, "stale_samples");
}

/// A sensor whose clock is slower than the recorder's: a repeat each 1 / p + 1 samples, and between
/// them no two samples are 16 away from any. By chance, distances spread as far as their mean: of
/// hundreds, never a third of it.
TEST(Marks, RepeatsAtEvenDistancesAreTold) {
  for (const double regular : {0.0, 1.0}) {
    Scenario s = still();
    s.effects = {effects::StaleSamples{0.075, 1.0, regular}, effects::Outliers{0.01, 0.5}};
    const auto series = recorded(s, 44, false);
    const auto marks = marks_in(series);
    EXPECT_EQ(marks.stale_is_regular, regular > 0.5);
    EXPECT_NEAR(marks.stale_probability, 0.075, 5.0 * std::sqrt(0.075 / 18000.0));
    const Simulator simulator(series, 1);
    const auto found = find_set(simulator, series, {});
    EXPECT_TRUE(std::any_of(found.members.begin(), found.members.end(),
                            [](const auto& member) { return member.effect == "outliers"; }));
  }
}

/// A level that rests, and noise, in grids: of 18000 samples.
Series resting(double level, double deviation, std::uint64_t seed) {
  constexpr double lsb_dps = 0.25;
  Scenario s;
  s.sampling = {1200.0, 20.0};
  s.random_error = {.phi = 0.0,
                    .delta1_dps = 0.0,
                    .delta2_dps = 0.0,
                    .measurement_noise_std_dps = lsb_dps * deviation};
  s.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = lsb_dps * level};
  s.effects = {effects::Quantization{lsb_dps}};
  Series series = recorded(s, seed, false);
  series.temperature_C.clear();
  series.heading_deg.clear();
  return series;
}

/// One in 260 samples has the rarest of three values: its place among normal ones, 2.7, is known to
/// 1 / (2.7 sqrt(68)), which is 0.045 of it, and 5 times that is allowed of both. Two values hold
/// the noise below a bound.
TEST(Marks, NoiseUnderAGridIsReadOffItsFewValues) {
  const auto three = marks_in(resting(0.3, 0.3, 45));
  ASSERT_TRUE(three.level_on_grid_dps.has_value());
  EXPECT_NEAR(three.white_under_grid_dps, 0.25 * 0.3, 0.25 * 5.0 * 0.045 * 0.3);
  EXPECT_NEAR(*three.level_on_grid_dps, 0.25 * 0.3, 0.25 * 5.0 * 0.045 * 0.3);
  const auto two = marks_in(resting(0.4, 0.1, 46));
  EXPECT_EQ(two.lsb_dps, 0.25);
  ASSERT_TRUE(two.level_on_grid_dps.has_value());
  EXPECT_LT(two.white_under_grid_dps, 0.25 * 0.4);
  EXPECT_GE(two.white_under_grid_dps, 0.25 * 0.1);
}

/// What a driver does to outputs about zero, its threshold moved by a normal share of itself.
void silence(Series& series, double half_width_dps, double lost_beyond, double moved_by) {
  const NormalStream moves(5, 0, "threshold");
  for (std::size_t i = 0; i < series.size(); ++i) {
    double& z = series.gyro_dps[i];
    const double width = half_width_dps * (1.0 + moved_by * moves.normal(i));
    z = std::abs(z) < width ? 0.0 : z - std::copysign(lost_beyond * width, z);
  }
}

/// The noise of 0.05 dps about 0.02 dps carries two thirds of the outputs at rest across a zone of
/// 0.02 dps. A threshold that stands is the least output; of one that moves the place is known to
/// 1 / sqrt(0.08 x 1400) of a twelfth of it, and of one that draws outputs in to a tenth of it: ten
/// and five times that are allowed.
TEST(Marks, AZoneOfTheOutputWithinItsNoiseIsReadOff) {
  Scenario s = turning_on_a_grid();
  s.effects.clear();
  const Series plain = recorded(s, 48, true);
  EXPECT_EQ(marks_in(plain).silent.half_width_dps, 0.0);
  const auto zone = [&](double lost_beyond, double moved_by) {
    Series series = plain;
    silence(series, 0.02, lost_beyond, moved_by);
    return marks_in(series).silent;
  };
  EXPECT_NEAR(zone(0.0, 0.0).half_width_dps, 0.02, 2e-4);
  EXPECT_NEAR(zone(0.0, 0.2).half_width_dps, 0.02, 2e-3);
  EXPECT_NEAR(zone(1.0, 0.0).half_width_dps, 0.02, 1e-2);
  EXPECT_EQ(zone(0.0, 0.2).lost_beyond, 0.0);
  EXPECT_EQ(zone(1.0, 0.0).lost_beyond, 1.0);
  // Zeros that say that nothing was measured come at any rate.
  Series dropped = plain;
  for (std::size_t i = 0; i < dropped.size(); i += 100) dropped.gyro_dps[i] = 0.0;
  EXPECT_EQ(marks_in(dropped).silent.half_width_dps, 0.0);
  // A grid of which every other sample is moved by a little has far more zeros than such a zone.
  Series grid = plain;
  const NormalStream noise(49, 0, "moved");
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (std::abs(grid.gyro_dps[i]) < 0.03)
      grid.gyro_dps[i] = i % 2 == 0 ? 0.0 : 1e-4 * noise.normal(i);
  EXPECT_EQ(marks_in(grid).silent.half_width_dps, 0.0);
}

/// A table that swings smoothly from rest to 40 dps and back, one way and the other: fewer outputs
/// lie between the zone's edge and the table's speed than 8 % of the zeros, and what is heard there
/// tells the edge from the speed. In three minutes five swings have some twelve outputs within the
/// zone's width beyond its edge: that none is in the first half happens once in 4,000.
TEST(Marks, AZoneOfTheOutputShowsThoughTheTableHardlyDwellsBesideIt) {
  constexpr double zone_dps = 0.3, period_s = 36.37, swing_s = 0.5;
  for (std::uint64_t seed = 60; seed < 64; ++seed) {
    Series series = turned(seed, [&](double t_s) {
      const double turn = t_s / period_s;
      const double into_s = (turn - std::floor(turn)) * period_s;
      const double edge_s = std::min(into_s, 30.0 - into_s);
      const double share = std::clamp(edge_s / swing_s, 0.0, 1.0);
      const double speed_dps = std::fmod(std::floor(turn), 2.0) < 1.0 ? 40.0 : -40.0;
      return 0.5 * speed_dps * (1.0 - std::cos(std::numbers::pi * share));
    });
    EXPECT_EQ(marks_in(series).silent.half_width_dps, 0.0);
    silence(series, zone_dps, 0.0, 0.0);
    for (const std::size_t samples : {std::size_t{3600}, std::size_t{7200}, series.size()}) {
      const auto zone = marks_in(series.slice(0, samples)).silent;
      EXPECT_NEAR(zone.half_width_dps, zone_dps, 0.5 * zone_dps) << samples;
    }
  }
}

/// At five deviations of the noise: whatever of a step the level is from a value, rounding explains
/// the recording, and nothing else is named.
TEST(Marks, RoundingToFarMoreThanTheNoiseClosesTheGap) {
  for (const double level : {0.05, 0.3, 0.45}) {
    auto series = resting(level, 0.2, 47);
    // A bias that was taken out after the converter.
    if (level == 0.3)
      for (double& z : series.gyro_dps) z += 0.1;
    const auto found = diagnose(series, {});
    EXPECT_EQ(found.verdict.text(), "quantization") << level;
    EXPECT_GT(found.closed, 0.9) << level;
    EXPECT_EQ(found.effects.size(), 1U) << level;
  }
}

/// A hand turns a sensor by up to 30 dps for two minutes: of 1,200 values hardly any two are
/// neighbours on a grid of an eighth of the noise, and all are on it.
TEST(Marks, AGridShowsThoughAMotionLeavesMostOfItsValuesOut) {
  Scenario s = moving();
  s.sampling = {120.0, 20.0};
  s.motion = motion::Sinusoidal{30.0, 0.11};
  s.effects = {effects::Quantization{0.0061}};
  EXPECT_NEAR(marks_in(recorded(s, 72, true)).lsb_dps, 0.0061, 1e-6);
  // To four decimals, as a log writes them, is no grid; every second hundredth is one.
  s.effects = {effects::Quantization{1e-4}};
  EXPECT_EQ(marks_in(recorded(s, 72, true)).lsb_dps, 0.0);
  s.effects = {effects::Quantization{0.02}};
  EXPECT_NEAR(marks_in(recorded(s, 72, true)).lsb_dps, 0.02, 1e-6);
}

/// Three gyros on grids, turned into another frame by an attitude that is known but for the first
/// twelfth, where it is held: there, and nowhere else, values are equal by chance, at any distance.
TEST(Marks, AGridThatIsThereForAPartMakesNoRepeats) {
  Series series = recorded(still(), 70, false);
  const NormalStream noise(71, 0, "three axes");
  for (std::size_t i = 0; i < series.size(); ++i) {
    double value = 0.0;
    const double turned = i < series.size() / 12 ? 0.3 : 0.3 + 0.01 * static_cast<double>(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double read = 0.06 * std::round(0.8 * noise.normal(3 * i + axis));
      value += read * std::sin(turned + 2.0 * static_cast<double>(axis));
    }
    series.gyro_dps[i] = value;
  }
  EXPECT_EQ(marks_in(series).stale_probability, 0.0);
  for (std::size_t i = 100; i + 1 < series.size(); i += 100)
    series.gyro_dps[i + 1] = series.gyro_dps[i];
  EXPECT_GT(marks_in(series).stale_probability, 0.005);
}

}  // namespace
}  // namespace gyrostat::gap::marks_test
