// Recordings that begin in the middle of a motion: what a sensor has not yet forgotten of before is
// no effect of its own.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gyrostat/diagnosis/known_motion.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/found_in.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::begun_before_test {
namespace {

/// Turns of three sines, which had gone on for 40 s.
Series from_the_middle(const std::vector<Effect>& effects, std::uint64_t seed) {
  Scenario s = moving();
  s.sampling = {440.0, 25.0};
  s.effects = effects;
  s.motion = turned_at_25_hz(11000, [](double t_s) {
    const auto turn = [&](double hz) { return std::sin(2.0 * std::numbers::pi * hz * t_s); };
    return 40.0 * turn(0.11) + 25.0 * turn(0.37) + 15.0 * turn(0.83);
  });
  const Series whole = recorded(s, seed, true);
  constexpr std::size_t before = 1000;
  Series series = whole.slice(before, whole.size() - before);
  for (double& t_s : series.t_s) t_s -= 40.0;
  return series;
}

/// The first samples lag by several dps; that was a bias that settles within half a second.
TEST(BegunBefore, AFilterHasNoStartUp) {
  EXPECT_EQ(found_in(from_the_middle(
                {effects::SensorBandwidth{.cutoff_hz = 1.0}, effects::ScaleAsymmetry{0.01}}, 31)),
            (std::set<std::string>{"scale_asymmetry", "sensor_bandwidth"}));
}

/// How the reference turned before its first sample is not known: by a shift of four samples the
/// first four are anything.
TEST(BegunBefore, AShiftHasNoStartUp) {
  std::vector<std::string> told;
  const auto series = with_known_motion(
      from_the_middle({effects::TimeOffset{.offset_s = 0.16}, effects::ScaleAsymmetry{0.01}}, 32),
      told);
  EXPECT_EQ(found_in(series), (std::set<std::string>{"scale_asymmetry", "time_offset"}));
}

/// What is clipped has its limit as its value, whatever a shift beside it would have it be.
TEST(BegunBefore, AShiftLeavesALimitWhereItIs) {
  const Series series = from_the_middle(
      {effects::TimeOffset{.offset_s = 0.06}, effects::Saturation{.limit_dps = 62.0},
       effects::WanderingLine{.amplitude_dps = 0.1,
                              .frequency_hz = 5.5,
                              .wander_hz = 0.5,
                              .correlation_time_s = 10.0}},
      33);
  const Simulator simulator(series, 1);
  for (const auto& effect : find_set(simulator, series, {}).scenario.effects)
    if (const auto* limit = effect.as<effects::Saturation>()) {
      EXPECT_DOUBLE_EQ(limit->limit_dps, 62.0);
      return;
    }
  ADD_FAILURE() << "no limit is found";
}

/// Where a compass trails, its first headings lag by what it had turned.
TEST(BegunBefore, ACompassThatTrailsHasNoBurst) {
  EXPECT_EQ(found_in(from_the_middle({effects::CompassLag{.time_constant_s = 0.5}}, 34)),
            std::set<std::string>{"compass_lag"});
}

}  // namespace
}  // namespace gyrostat::gap::begun_before_test
