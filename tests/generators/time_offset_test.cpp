#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/generators/beyond_secant.hpp>
#include <gyrostat/generators/environment/motion/list.hpp>
#include <gyrostat/generators/scenario.hpp>
#include <gyrostat/tests/generators/effect_series.hpp>

namespace gyrostat::time_offset_test {
namespace {

/// Of a rate that is straight in time a shift is exact: 5 ms and 2 ms a second of 3 dps/s.
/// A compass on the gyro's board shows the heading of as much earlier; one elsewhere does not.
TEST(TimeOffset, IsTheCompassesWhereItHasTheClock) {
  Scenario scenario;
  scenario.sampling = {60.0, 20.0};
  scenario.motion = motion::RateTable{30.0, 10.0};
  scenario.compass.noise_std_deg = 0.0;
  Series true_to_time, series;
  synthesise(scenario, {1, 0}, true_to_time);
  for (const double of_compass : {0.0, 1.0}) {
    scenario.effects = {effects::TimeOffset{.offset_s = 0.2, .of_compass = of_compass}};
    synthesise(scenario, {1, 0}, series);
    const std::size_t late = of_compass > 0.5 ? 4 : 0;
    for (std::size_t i = 4; i < series.size(); ++i)
      EXPECT_NEAR(wrap_degrees(series.heading_deg[i] - true_to_time.heading_deg[i - late]), 0.0,
                  1e-9);
  }
}

TEST(TimeOffset, GrowsWithClocksOfUnlikePace) {
  std::vector<double> ramp;
  for (int i = 0; i < 500; ++i) ramp.push_back(0.03 * i);
  const auto z = sensed(effects::TimeOffset{.offset_s = 0.005, .drift_ppm = 2000.0}, ramp);
  for (std::size_t i = 10; i < 490; ++i)
    EXPECT_NEAR(z[i], ramp[i] - 3.0 * (0.005 + 0.002 * 0.01 * static_cast<double>(i)), 1e-9) << i;
  EXPECT_EQ(sensed(effects::TimeOffset{.offset_s = 0.0}, ramp), ramp);
}

TEST(TimeOffset, OfWholeSamplesShiftsTheRateAndHoldsItsEnds) {
  const std::vector<double> rates = {1.0, 5.0, -2.0, 7.0, 7.5, 3.0};
  const auto late = sensed(effects::TimeOffset{.offset_s = 0.02}, rates);
  const auto early = sensed(effects::TimeOffset{.offset_s = -0.02}, rates);
  for (std::size_t i = 0; i < rates.size(); ++i) {
    EXPECT_NEAR(late[i], rates[i < 2 ? 0 : i - 2], 1e-11) << i;
    EXPECT_NEAR(early[i], rates[std::min<std::size_t>(i + 2, 5)], 1e-11) << i;
  }
}

TEST(TimeOffset, OfAStraightRateIsAMeanOfNeighbours) {
  const std::vector<double> rates = {1.0, 5.0, -2.0, 7.0, 7.5, 3.0};
  const auto late = sensed(effects::TimeOffset{.offset_s = 0.0137, .straight = 1.0}, rates);
  const auto early = sensed(effects::TimeOffset{.offset_s = -0.0025, .straight = 1.0}, rates);
  for (std::size_t i = 2; i < rates.size(); ++i)
    EXPECT_NEAR(late[i], 0.63 * rates[i - 1] + 0.37 * rates[i - 2], 1e-11) << i;
  for (std::size_t i = 0; i + 1 < rates.size(); ++i)
    EXPECT_NEAR(early[i], 0.75 * rates[i] + 0.25 * rates[i + 1], 1e-11) << i;
}

TEST(TimeOffset, OfAParabolaIsExactBetweenSamples) {
  std::vector<double> parabola;
  for (int i = 0; i < 100; ++i) parabola.push_back(0.01 * i * i);
  for (const double samples : {0.5, -0.3, 4.25}) {
    const auto z = sensed(effects::TimeOffset{.offset_s = 0.01 * samples}, parabola);
    for (int i = 10; i < 90; ++i) EXPECT_NEAR(z[i], 0.01 * std::pow(i - samples, 2), 1e-10) << i;
  }
}

/// Slopes are right to 1.2 % and to 3e-4, of whose difference an eighth is the error in the middle,
/// and a cubic with the right slopes misses a sine by its fourth power over 384.
TEST(TimeOffset, OfASineIsNearlyThatSine) {
  struct Known {
    double samples_a_turn, error;
  };
  for (const auto& [samples_a_turn, error] : {Known{8.0, 2e-3}, Known{20.0, 4e-5}}) {
    std::vector<double> sine;
    const double turn = 2.0 * std::numbers::pi / samples_a_turn;
    for (int i = 0; i < 200; ++i) sine.push_back(std::sin(turn * i + 0.1));
    for (const double samples : {0.054, 0.25, 0.5, 0.8, -0.5, 7.4}) {
      const auto z = sensed(effects::TimeOffset{.offset_s = 0.01 * samples}, sine);
      for (int i = 20; i < 180; ++i)
        EXPECT_NEAR(z[i], std::sin(turn * (i - samples) + 0.1), error) << samples << " at " << i;
    }
  }
}

/// Beside a jump and a kink there is no smooth signal whose slope could be told better.
TEST(BeyondSecant, OfWhatIsNotSmoothIsNothing) {
  std::vector<double> jump, kink;
  for (int i = 0; i < 40; ++i) {
    jump.push_back(i < 20 ? 0.0 : 50.0);
    kink.push_back(std::abs(i - 20));
  }
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(beyond_secant(jump, i, 0, 40), 0.0) << i;
    EXPECT_EQ(beyond_secant(kink, i, 0, 40), 0.0) << i;
  }
}

TEST(TimeOffset, OverUnevenIntervalsFollowsAnEvenGrowth) {
  auto series = silent({0.0, 0.1, 0.15, 0.9, 1.0, 1.5});
  series.rate_ref_dps = series.gyro_dps = series.t_s;
  effects::TimeOffset{.offset_s = 0.07}.apply(series, {1, 0});
  EXPECT_EQ(series.gyro_dps[0], 0.0);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_NEAR(series.gyro_dps[i], series.t_s[i] - 0.07, 1e-12);
}

}  // namespace
}  // namespace gyrostat::time_offset_test
