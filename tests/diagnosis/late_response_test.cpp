// Clocks that differ, looked up straight in a table, and beside a filter.

#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

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

INSTANTIATE_TEST_SUITE_P(Samples, LateResponse, testing::Values(2.4, -1.63));

}  // namespace
}  // namespace gyrostat::gap::late_response_test
