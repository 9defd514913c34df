// Sets by likelihood: what a compass has.

#include <gyrostat/diagnosis/likelihood/set_search.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/found_in.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::sets_of_compass_test {
namespace {

/// Fields that come and go softly, nowhere far beyond the noise of a cluster.
TEST(SetSearch, AFieldThatPassesSoftlyIsABurst) {
  Series series = recorded(moving(), 81, true);
  constexpr double duration_s = 8.0, size_deg = 0.5;
  for (const double begin_s : {210.0, 700.0})
    for (std::size_t i = 0; i < series.size(); ++i)
      if (const double x = (series.t_s[i] - begin_s) / duration_s; x > 0.0 && x < 1.0)
        series.heading_deg[i] += 0.5 * size_deg * (1.0 - std::cos(2.0 * std::numbers::pi * x));
  EXPECT_EQ(found_in(series), std::set<std::string>{"magnetic_bursts"});
}

/// Whether a sample has turned by its own rate, by half of it or not yet is the recorder's habit.
TEST(SetSearch, AHeadingThatIsHalfASampleLateHasNoLag) {
  for (const double late : {-0.5, 1.0}) {
    const auto series = recorded(moving(ten_minutes_s), 21, true);
    Series shifted = series;
    for (std::size_t i = 0; i < series.size(); ++i) {
      const std::size_t next = std::min(i + 1, series.size() - 1);
      const double mean_rate = 0.5 * (series.rate_ref_dps[i] + series.rate_ref_dps[next]);
      shifted.heading_deg[i] =
          std::remainder(series.heading_deg[i] - late * mean_rate / 20.0, 360.0);
    }
    EXPECT_EQ(found_in(shifted), std::set<std::string>{}) << late;
  }
}

/// The rates of a reference seldom add up to its heading: neither what is left over minutes nor a
/// half sample beside iron has a name.
TEST(SetSearch, AReferenceWhoseRatesDoNotAddUpHasNoIron) {
  for (const double amplitude_deg : {0.0, 2.0}) {
    Scenario s = moving(ten_minutes_s);
    if (amplitude_deg > 0.0) s.effects = {effects::HardIron{amplitude_deg, 40.0}};
    auto series = recorded(s, 24, true);
    const NormalStream steps(24, 0, "wander");
    double wander_deg = 0.0;
    for (std::size_t i = 0; i < series.size(); ++i) {
      wander_deg += 0.002 * steps.normal(i);
      series.heading_deg[i] = std::remainder(
          series.heading_deg[i] + wander_deg - 0.5 * series.rate_ref_dps[i] / 20.0, 360.0);
    }
    std::set<std::string> expected;
    if (amplitude_deg > 0.0) expected = {"hard_iron"};
    EXPECT_EQ(found_in(series), expected);
  }
}

/// Iron that trails with the heading, and iron that does not.
TEST(SetSearch, IronBesideALagIsFoundInEitherForm) {
  for (const double turns_alone : {0.0, 1.0}) {
    Scenario s = moving(ten_minutes_s);
    s.effects = {effects::HardIron{5.0, 40.0},
                 effects::CompassLag{.time_constant_s = 0.4, .turns_alone = turns_alone}};
    const auto series = recorded(s, 23, true);
    const Simulator simulator(series, 1);
    const auto found = find_set(simulator, series, {});
    std::set<std::string> names;
    for (const auto& member : found.members) names.insert(member.effect);
    EXPECT_EQ(names, (std::set<std::string>{"compass_lag", "hard_iron"}));
    // Noise of 0.3 degrees and nothing else is left: its standard error is a part in 200.
    EXPECT_NEAR(found.scenario.compass.noise_std_deg, 0.3, 5.0 * 0.3 / 200.0);
  }
}

/// A lag has its form and its place before the iron is known that it delays, and which one it is
/// decides what iron is left: with others, two poles were one and a delay, and hard iron there,
/// too.
TEST(SetSearch, ALagIsToldAnewBesideTheIronThatItDelays) {
  Scenario s = moving(ten_minutes_s);
  s.effects = {effects::SoftIron{3.0, 70.0},
               effects::CompassLag{.time_constant_s = 1.0, .poles = 2.0}};
  const auto series = recorded(s, 25, true);
  const Simulator simulator(series, 1);
  const auto found = find_set(simulator, series, {});
  std::set<std::string> names;
  for (const auto& member : found.members) names.insert(member.effect);
  EXPECT_EQ(names, (std::set<std::string>{"compass_lag", "soft_iron"}));
  EXPECT_NEAR(found.scenario.compass.noise_std_deg, 0.3, 5.0 * 0.3 / 200.0);
}

/// On a table that rests in two directions the error beside iron of two degrees is centred
/// elsewhere than beside none; about that of none, bursts at each turn were as likely.
TEST(SetSearch, IronThatShowsInTurnsAloneIsNoBursts) {
  Scenario s = moving(ten_minutes_s);
  s.motion = motion::RateTable{60.0, 24.0};
  s.effects = {effects::HardIron{2.0, 39.0}};
  EXPECT_EQ(found_in(recorded(s, 96, true)), (std::set<std::string>{"hard_iron"}));
}

/// Iron of an eighth of the noise, which gains a thousandth of what the delay does: beside it
/// nothing of the motion is left.
TEST(SetSearch, FaintIronBesideADelayIsFound) {
  Scenario s = moving(ten_minutes_s);
  s.compass.noise_std_deg = 0.4;
  s.effects = {effects::HardIron{0.05, 88.0},
               effects::CompassLag{.time_constant_s = 0.0, .delay_s = 0.33, .turns_alone = 1.0}};
  EXPECT_EQ(found_in(recorded(s, 88, true)), (std::set<std::string>{"compass_lag", "hard_iron"}));
}

/// A board that stamps both gyro and compass: one clock is late, and no compass.
TEST(SetSearch, ACompassOnTheGyrosBoardHasItsClock) {
  Scenario s = moving(ten_minutes_s);
  for (const double of_compass : {0.0, 1.0}) {
    s.effects = {effects::TimeOffset{.offset_s = 0.12, .of_compass = of_compass},
                 effects::SoftIron{1.0, 40.0}};
    const auto series = recorded(s, 97, true);
    const Simulator simulator(series, 1);
    const auto found = find_set(simulator, series, {});
    std::set<std::string> names;
    for (const auto& member : found.members) names.insert(member.effect);
    EXPECT_EQ(names, (std::set<std::string>{"soft_iron", "time_offset"}));
    for (const auto& effect : found.scenario.effects)
      if (const auto* clock = effect.as<effects::TimeOffset>()) {
        EXPECT_EQ(clock->of_compass, of_compass);
      }
    EXPECT_NEAR(found.scenario.compass.noise_std_deg, 0.3, 5.0 * 0.3 / 200.0);
  }
}

/// Iron of a degree and a half on a vehicle that turns through a bit more than a quarter of a
/// circle.
TEST(SetSearch, IronShowsOnAnArc) {
  Scenario s = moving(ten_minutes_s);
  s.motion = motion::Sinusoidal{12.0, 0.031};
  s.effects = {effects::HardIron{1.5, 40.0}};
  EXPECT_EQ(found_in(recorded(s, 98, true)), std::set<std::string>{"hard_iron"});
  s.effects.clear();
  EXPECT_EQ(found_in(recorded(s, 99, true)), std::set<std::string>{});
}

/// What a lag of one pole has beside it, and a delay without one, at turns that begin at once.
TEST(SetSearch, ACompassThatDelaysHasALagAlone) {
  Scenario s = moving(ten_minutes_s);
  s.motion = motion::RateTable{60.0, 20.0};
  for (const auto& lag : {effects::CompassLag{.time_constant_s = 0.3, .delay_s = 0.025},
                          effects::CompassLag{.time_constant_s = 0.0, .delay_s = 0.6}}) {
    s.effects = {lag};
    EXPECT_EQ(found_in(recorded(s, 22, true)), std::set<std::string>{"compass_lag"}) << lag.delay_s;
  }
}

}  // namespace
}  // namespace gyrostat::gap::sets_of_compass_test
