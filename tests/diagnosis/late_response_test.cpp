// Clocks that differ, looked up straight in a table, and beside a filter.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/diagnosis/known_motion.hpp>
#include <gyrostat/diagnosis/likelihood/set_search.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>
#include <gyrostat/tests/diagnosis/turning.hpp>

namespace gyrostat::gap::late_response_test {
namespace {

std::set<std::string> names_of(const FoundSet& found) {
  std::set<std::string> names;
  for (const auto& member : found.members) names.insert(member.effect);
  return names;
}

template <class E>
const E& only(const FoundSet& found) {
  for (const auto& effect : found.scenario.effects)
    if (const auto* named = effect.as<E>()) return *named;
  throw std::runtime_error("not found");
}

class LateResponse : public testing::TestWithParam<double> {};

/// As np.interp() has it. A cubic left so much of it that a filter stood beside or instead.
TEST_P(LateResponse, OfAStraightRateIsAShift) {
  const double samples = GetParam();
  const auto series =
      turning({effects::TimeOffset{.offset_s = 0.04 * samples, .straight = 1.0}}, 41);
  const Simulator simulator(series, 1);
  const auto found = find_set(simulator, series, {});
  ASSERT_EQ(names_of(found), (std::set<std::string>{"time_offset"}));
  const auto& shift = only<effects::TimeOffset>(found);
  EXPECT_EQ(shift.straight, 1.0);
  EXPECT_NEAR(shift.offset_s, 0.04 * samples, 0.01 * 0.04);
}

/// Neither is found alone: early by what the filter is late, there is nothing to be late by.
TEST_P(LateResponse, OfAShiftAndAFilterIsBoth) {
  const double samples = GetParam();
  const auto series = turning(
      {effects::TimeOffset{.offset_s = 0.04 * samples, .straight = samples < 0.0 ? 1.0 : 0.0},
       effects::SensorBandwidth{.cutoff_hz = 3.0, .poles = 2.0, .maximally_flat = 1.0}},
      42);
  const Simulator simulator(series, 1);
  const auto found = find_set(simulator, series, {});
  ASSERT_EQ(names_of(found), (std::set<std::string>{"sensor_bandwidth", "time_offset"}));
  EXPECT_NEAR(only<effects::TimeOffset>(found).offset_s, 0.04 * samples, 0.02 * 0.04);
  // Forms of it, over samples or between them, are alike where cutoffs are 5 % apart.
  EXPECT_NEAR(only<effects::SensorBandwidth>(found).cutoff_hz, 3.0, 0.15);
}

/// Where a table has jumped between two samples, a cubic and a straight line are two recordings;
/// with those samples hidden, as they are while a scale is looked for, they are one.
TEST(LateShift, OfATableThatJumpsKeepsItsForm) {
  Scenario s = still();
  s.motion = motion::RateTable{60.0, 24.0};
  s.effects = {effects::TimeOffset{.offset_s = 0.1 / s.sampling.rate_hz},
               effects::ScaleTemperature{.scale_per_C = 1e-4, .reference_C = 40.0}};
  const auto series = recorded(s, 44, true);
  const Simulator simulator(series, 1);
  const auto found = find_set(simulator, series, {});
  ASSERT_EQ(names_of(found), (std::set<std::string>{"scale_temperature", "time_offset"}));
  EXPECT_EQ(only<effects::TimeOffset>(found).straight, 0.0);
}

/// A sine is late by a filter as by a shift, and as likely by either but for some nats: which of
/// the two was fitted further does not tell. Nothing that was tried in a member's place is likelier
/// than what stands.
TEST(LateSine, HasNoRivalThatIsLikelierThanWhatStands) {
  struct Sampled {
    double duration_s, rate_hz, cutoff_hz;
    std::uint64_t seed;
  };
  for (const auto& [duration_s, rate_hz, cutoff_hz, seed] :
       {Sampled{300.0, 50.0, 11.5, 61}, Sampled{ten_minutes_s, 20.0, 2.0, 65}}) {
    Scenario s = moving(duration_s);
    s.sampling.rate_hz = rate_hz;
    s.temperature = temperature::QuietRoom{37.8, 40.1, 300.0};
    s.motion = motion::Sinusoidal{25.0, 0.5};
    s.random_error.measurement_noise_std_dps = 0.07;
    s.compass.initial_heading_deg = 20.0;
    s.effects = {
        effects::TimeOffset{.offset_s = 0.03},
        effects::NoiseBandwidth{.cutoff_hz = cutoff_hz, .poles = 2.0, .maximally_flat = 1.0}};
    std::vector<std::string> told;
    const auto series = with_known_motion(recorded(s, seed, true), told);
    const Simulator simulator(series, 1);
    const auto found = find_set(simulator, series, {});
    for (const auto& rival : found.rivals)
      EXPECT_LE(rival.log_odds, 0.1) << rival.effect << " for " << rival.instead_of;
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, LateResponse, testing::Values(2.4, -1.63));

}  // namespace
}  // namespace gyrostat::gap::late_response_test
