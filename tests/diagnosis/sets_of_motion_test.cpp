// Sets by likelihood: what a sensor makes of a motion.

#include <gyrostat/diagnosis/likelihood/set_search.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/found_in.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::sets_of_motion_test {
namespace {

/// Turns of a hand, a value each sample and seven between them: so smooth that those between are
/// known from the others far below the noise.
std::vector<double> turns(std::size_t samples) {
  const NormalStream noise(5, 0, "turns");
  std::vector<double> rate(8 * samples);
  double torque = 0.0, now = 0.0, arm = 0.0;
  for (std::size_t i = 0; i < rate.size(); ++i) {
    torque += (4.0 * noise.normal(i) - torque) / 160.0;
    now += torque - now / 400.0;
    arm += (now - arm) / 20.0;
    rate[i] = arm;
  }
  return rate;
}

/// Systems of second order at 5 Hz, one after the other, in continuous time, of a motion whose
/// reference is known at the samples alone.
Series turned_before_systems_of_second_order(const std::vector<double>& dampings) {
  Series series = recorded(still(ten_minutes_s), 80, false);
  series.heading_deg.clear();
  const auto fine = turns(series.size());
  const double step_s = 1.0 / 160.0, omega = 2.0 * std::numbers::pi * 5.0;
  std::vector<double> seen(dampings.size(), 0.0), rising(dampings.size(), 0.0);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    if (i % 8 == 0) {
      series.rate_ref_dps.push_back(fine[i]);
      series.gyro_dps[i / 8] += seen.back();
    }
    // Straight from one to the next, in steps of a hundredth of the filter's own time.
    constexpr int steps = 64;
    for (int k = 0; k < steps && i + 1 < fine.size(); ++k) {
      double rate = fine[i] + (fine[i + 1] - fine[i]) * k / steps;
      for (std::size_t n = 0; n < dampings.size(); ++n) {
        rising[n] +=
            step_s / steps * omega * (omega * (rate - seen[n]) - 2.0 * dampings[n] * rising[n]);
        rate = seen[n] += step_s / steps * rising[n];
      }
    }
  }
  return series;
}

TEST(SetSearch, AButterworthSensorIsOneOfContinuousTime) {
  const Series series = turned_before_systems_of_second_order({std::numbers::sqrt2 / 2.0});
  const Simulator simulator(series, 1);
  const auto found = find_set(simulator, series, {});
  ASSERT_EQ(found.members.size(), 1u);
  const auto* filter = found.scenario.effects.at(0).as<effects::SensorBandwidth>();
  ASSERT_NE(filter, nullptr);
  EXPECT_EQ(filter->continuous, 1.0);
  // The same filter by either of its forms.
  const double damping =
      filter->maximally_flat > 0.5 ? 0.5 * std::numbers::sqrt2 : filter->damping_ratio;
  EXPECT_NEAR(damping, 0.5 * std::numbers::sqrt2, 0.01);
  EXPECT_NEAR(filter->cutoff_hz, 5.0, 0.1);
}

/// The zone is where the shifted rate passes zero, five widths of it from where the rate does.
TEST(SetSearch, ADeadZoneIsFoundWhereTheRateIsSensed) {
  Scenario s = moving(ten_minutes_s);
  s.effects = {effects::TimeOffset{.offset_s = 0.4},
               effects::DeadZone{.half_width_dps = 0.6, .lost_beyond = 0.0}};
  const auto series = recorded(s, 83, true);
  const Simulator simulator(series, 1);
  const auto found = find_set(simulator, series, {});
  const auto zone = std::find_if(found.scenario.effects.begin(), found.scenario.effects.end(),
                                 [](const auto& effect) { return effect.id() == "dead_zone"; });
  ASSERT_NE(zone, found.scenario.effects.end());
  EXPECT_NEAR(zone->template as<effects::DeadZone>()->half_width_dps, 0.6, 0.1);
  EXPECT_EQ(found.members.size(), 2U);
}

/// The motion passes from one sample to the next by 0.8 dps, so that few are near the edge: those
/// alone say where it is, to the next of them on either side, and the noise cannot mistake them.
TEST(SetSearch, AThresholdIsBetweenItsSamples) {
  Scenario s = moving(ten_minutes_s);
  s.effects = {effects::DeadZone{.half_width_dps = 2.0}};
  const auto series = recorded(s, 85, true);
  const Simulator simulator(series, 1);
  const auto found = find_set(simulator, series, {});
  ASSERT_EQ(found.scenario.effects.size(), 1U);
  const auto* zone = found.scenario.effects[0].as<effects::DeadZone>();
  ASSERT_NE(zone, nullptr);
  for (const auto& span : simulator.conditions().spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      EXPECT_EQ(std::abs(series.rate_ref_dps[i]) <= 2.0,
                std::abs(series.rate_ref_dps[i]) <= zone->half_width_dps);
}

/// Of a shift by a sample on a rate table there is one sample a step, which a limit, a scale, a
/// filter and a dead zone of half the range made together.
TEST(SetSearch, AShiftThatHasNoNameIsNotALimitAndADeadZone) {
  Scenario s = moving(ten_minutes_s);
  s.motion = motion::RateTable{60.0, 24.0};
  s.effects = {effects::TimeOffset{.offset_s = 0.05}};
  for (const std::uint64_t seed : {86, 87}) {
    const auto series = recorded(s, seed, true);
    const Simulator simulator(series, 1);
    const auto found = find_set(simulator, series, {.without = {"time_offset"}});
    for (const auto& member : found.members) {
      EXPECT_NE(member.effect, "dead_zone") << seed;
      EXPECT_NE(member.effect, "saturation") << seed;
    }
    EXPECT_FALSE(found.nameless(found.scenario).empty()) << seed;
  }
}

/// Both parameters are of the motion, which is hundreds of times the noise: what limits them is how
/// well the rate between samples is known.
TEST(SetSearch, ASensorOfSecondOrderIsFoundWithItsDamping) {
  const Series series = turned_before_systems_of_second_order({0.35});
  const Simulator simulator(series, 1);
  const auto found = find_set(simulator, series, {});
  ASSERT_EQ(found.members.size(), 1u);
  const auto* system = found.scenario.effects.at(0).as<effects::SensorBandwidth>();
  ASSERT_NE(system, nullptr);
  EXPECT_NEAR(system->cutoff_hz, 5.0, 0.05);
  EXPECT_NEAR(system->damping_ratio, 0.35, 0.01);
}

/// What no name explains of a response must not pass for noise: nothing rings twice in the
/// catalogue.
TEST(SetSearch, AResponseOfAnotherFormIsNoNoise) {
  const Series series = turned_before_systems_of_second_order({0.35, 0.35});
  const Simulator simulator(series, 1);
  const auto found = find_set(simulator, series, {});
  ASSERT_EQ(found.members.size(), 1u);
  EXPECT_EQ(found.members[0].effect, "sensor_bandwidth");
  const auto nameless = found.nameless(found.scenario);
  EXPECT_TRUE(std::any_of(nameless.begin(), nameless.end(), [](const auto& part) {
    return part.effect.id() == "empirical_response";
  }));
  // A subset is fitted without that response; what would have been found is not.
  const auto sizes = [&] {
    std::vector<double> all;
    for (const auto& seen_at : found.detectable())
      all.push_back(seen_at.effect.value(seen_at.field));
    return all;
  };
  const auto before = sizes();
  EXPECT_FALSE(before.empty());
  found.subset({});
  EXPECT_EQ(sizes(), before);
}

/// Of the element, a tenth of a dps below the fastest rate: so near that it cuts or does not on
/// neighbouring points of any grid of limits.
TEST(SetSearch, ALimitJustBelowTheFastestRateIsFound) {
  Scenario s = moving(ten_minutes_s);
  s.effects = {effects::ScaleAsymmetry{0.003},
               effects::Saturation{.limit_dps = 79.9, .of_element = 1.0}};
  EXPECT_EQ(found_in(recorded(s, 94, true)),
            (std::set<std::string>{"saturation", "scale_asymmetry"}));
}

/// A slow filter and a shift against it are as late as the filter that is there. Without the one
/// the other had stayed as it was, 0.19 s early, at a cost of 3,000 nats.
TEST(SetBench, WhatStaysOfAFilterAndAShiftIsAsLateAsBoth) {
  Scenario s = moving(ten_minutes_s);
  s.effects = {effects::SensorBandwidth{3.0}};
  const Series series = recorded(s, 33, true);
  const Simulator simulator(series, 1);
  const SetBench bench(simulator, series, {});
  const auto alone = bench.beside_noise(s.effects);
  const auto both = bench.beside_noise(
      {effects::TimeOffset{-0.1883},
       effects::SensorBandwidth{
           .cutoff_hz = 1.023, .poles = 2.0, .maximally_flat = 1.0, .continuous = 2.0}});
  constexpr double a_few = 5.0;  // nats
  EXPECT_GT(bench.without(both, 0).score, alone.score - a_few);
  // A shift is not all that a filter does to this motion, but nearly.
  constexpr double little = 50.0;
  EXPECT_GT(bench.without(both, 1).score, alone.score - little);
}

/// A scale that changes with temperature is right at some temperature that was met, or in a room,
/// and still no scale factor besides.
TEST(SetSearch, AScaleThatIsRightAtATemperatureMetIsOneEffect) {
  Scenario s = moving(ten_minutes_s);
  for (const double right_C : {25.0, 32.0}) {
    s.temperature = temperature::Cycle{right_C == 25.0 ? 28.0 : 23.0, 57.0, 800.0};
    s.effects = {effects::ScaleTemperature{5e-4, right_C}};
    EXPECT_EQ(found_in(recorded(s, 22, true)), std::set<std::string>{"scale_temperature"})
        << right_C;
  }
}

/// The rounded corners of a dead zone, two of its widths wide, are no other scale.
TEST(SetSearch, ADeadZoneUnderADitherIsOneEffect) {
  Scenario s = moving(ten_minutes_s);
  s.motion = motion::Sinusoidal{8.0, 0.031};
  s.effects = {effects::DeadZone{.half_width_dps = 0.6, .lost_beyond = 1.0, .dither = 0.5}};
  EXPECT_EQ(found_in(recorded(s, 43, true)), std::set<std::string>{"dead_zone"});
}

/// Of a damped filter half of what the motion shows is the delay: it stood for both, tens of
/// thousands of nats below.
TEST(SetSearch, AShiftBesideAScaleIsNoFilter) {
  Scenario s = moving(ten_minutes_s);
  s.effects = {effects::ScaleFactor{0.02}, effects::TimeOffset{.offset_s = 0.12}};
  EXPECT_EQ(found_in(recorded(s, 45, true)),
            (std::set<std::string>{"scale_factor", "time_offset"}));
}

/// A scale of its own each way, behind a limit that a third of the motion goes beyond: what is
/// clipped says nothing of it.
TEST(SetSearch, AnAsymmetryIsFoundBesideALimitThatIsReached) {
  Scenario s = moving(ten_minutes_s);
  s.effects = {effects::ScaleAsymmetry{.error = 0.0175}, effects::Saturation{60.0}};
  EXPECT_EQ(found_in(recorded(s, 52, true)),
            (std::set<std::string>{"saturation", "scale_asymmetry"}));
}

}  // namespace
}  // namespace gyrostat::gap::sets_of_motion_test
