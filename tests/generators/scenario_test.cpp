#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/generators/environment/acceleration/list.hpp>
#include <gyrostat/generators/environment/motion/list.hpp>
#include <gyrostat/generators/environment/temperature/list.hpp>
#include <gyrostat/generators/scenario.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace gyrostat::scenario_test {
namespace {

Series synthesised(const Scenario& scenario, const Noise& noise = {1, 0}) {
  Series series;
  synthesise(scenario, noise, series);
  return series;
}

std::vector<std::uint64_t> bits_of(const std::vector<double>& values) {
  std::vector<std::uint64_t> bits;
  for (const double v : values) bits.push_back(std::bit_cast<std::uint64_t>(v));
  return bits;
}

bool same_bits(const Series& a, const Series& b) {
  for (const auto& channel : channels)
    if (bits_of(a.*channel.values) != bits_of(b.*channel.values)) return false;
  return true;
}

/// Everything at once, short.
Scenario busy() {
  Scenario scenario;
  scenario.sampling = {.duration_s = 120.0, .rate_hz = 20.0};
  scenario.thermal_drift = {.a_dps_per_C = 0.002, .b_dps_s_per_C = 0.3, .c_dps = -0.05};
  scenario.temperature = temperature::Cycle{.low_C = 20.0, .high_C = 50.0, .period_s = 60.0};
  scenario.motion = motion::RateTable{};
  scenario.compass.disturbances = {{.start_s = 30.0, .duration_s = 20.0}};
  scenario.effects = {effects::ThermalCurvature{}, effects::ThermalHysteresis{},
                      effects::Outliers{.probability = 0.05}};
  return scenario;
}

TEST(Sampling, CountsItsSamplesAndNeverNone) {
  EXPECT_EQ((Sampling{.duration_s = 60.0, .rate_hz = 100.0}.samples()), 6000U);
  EXPECT_EQ((Sampling{.duration_s = 0.3, .rate_hz = 10.0}.samples()), 3U);
  EXPECT_EQ((Sampling{.duration_s = 1e-9, .rate_hz = 1.0}.samples()), 1U);
}

TEST(Synthesise, TheLinearDriftIsATPlusBSlopePlusC) {
  auto scenario = busy();
  scenario.effects.clear();
  const auto series = synthesised(scenario);
  const auto& T = series.temperature_C;
  for (std::size_t i = 1; i < series.size(); ++i) {
    const double slope = (T[i] - T[i - 1]) / (series.t_s[i] - series.t_s[i - 1]);
    EXPECT_DOUBLE_EQ(series.thermal_bias_dps[i], 0.002 * T[i] + 0.3 * slope - 0.05);
  }
  EXPECT_DOUBLE_EQ(series.thermal_bias_dps[0], 0.002 * T[0] + 0.3 * (T[1] - T[0]) / 0.05 - 0.05);
}

TEST(Synthesise, TheGyroIsTheSumOfItsParts) {
  auto scenario = busy();
  scenario.random_error.measurement_noise_std_dps = 0.0;
  scenario.effects.pop_back();
  const auto series = synthesised(scenario);
  for (std::size_t i = 0; i < series.size(); ++i)
    EXPECT_DOUBLE_EQ(series.gyro_dps[i], series.rate_ref_dps[i] + series.thermal_bias_dps[i] +
                                             series.random_error_dps[i]);
}

TEST(Synthesise, EveryChannelOfASimulationIsAsLongAsTheSignal) {
  const auto series = synthesised(busy());
  for (const auto* channel : {&series.t_s, &series.gyro_dps, &series.temperature_C,
                              &series.heading_deg, &series.mag_valid, &series.rate_ref_dps,
                              &series.thermal_bias_dps, &series.random_error_dps})
    EXPECT_EQ(channel->size(), 2400U);
}

TEST(Synthesise, ASignalOfOneSampleIsFinite) {
  auto scenario = busy();
  scenario.sampling.duration_s = 1e-3;
  const auto series = synthesised(scenario);
  ASSERT_EQ(series.size(), 1U);
  EXPECT_TRUE(std::isfinite(series.gyro_dps[0]));
}

TEST(Synthesise, ATrialsSignalDoesNotDependOnWhatRanBefore) {
  Series reused;
  auto longer = busy();
  longer.sampling.duration_s = 300.0;
  synthesise(longer, {9, 9}, reused);
  synthesise(busy(), {1, 4}, reused);
  EXPECT_TRUE(same_bits(reused, synthesised(busy(), {1, 4})));
  reused.acc_x_mps2.assign(17, 1.0);
  synthesise(busy(), {1, 4}, reused);
  EXPECT_TRUE(same_bits(reused, synthesised(busy(), {1, 4})));
}

TEST(Synthesise, TrialsAndSeedsAreDifferentSignals) {
  EXPECT_NE(synthesised(busy(), {1, 0}).gyro_dps, synthesised(busy(), {1, 1}).gyro_dps);
  EXPECT_NE(synthesised(busy(), {1, 0}).gyro_dps, synthesised(busy(), {2, 0}).gyro_dps);
}

/// Two errors of the same law that were the same would have four times the square of one. Each has
/// the variance 1; its sum over n samples is known to sqrt(2 / n), times two here, and 5 times that
/// is allowed.
TEST(Synthesise, TwoEffectsOfAKindAreNotTheSame) {
  Scenario s;
  s.sampling = {.duration_s = 120.0, .rate_hz = 20.0};
  s.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.0};
  s.effects = {effects::Outliers{.probability = 1.0, .std_dps = 1.0},
               effects::Outliers{.probability = 1.0, .std_dps = 1.0}};
  const auto series = synthesised(s, {3, 0});
  double squares = 0.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double error = series.gyro_dps[i] - series.rate_ref_dps[i] - series.thermal_bias_dps[i];
    squares += error * error;
  }
  const auto n = static_cast<double>(series.size());
  EXPECT_NEAR(squares / n, 2.0, 5.0 * 2.0 * std::sqrt(2.0 / n));
}

TEST(Synthesise, ADisturbanceOfTheCompassMovesNothingElse) {
  auto scenario = busy();
  const auto before = synthesised(scenario);
  scenario.compass.disturbances.clear();
  scenario.compass.noise_std_deg = 3.0;
  const auto after = synthesised(scenario);
  for (const auto& channel : channels) {
    const bool of_compass = channel.name == "heading_deg" || channel.name == "mag_valid";
    EXPECT_EQ(bits_of(before.*channel.values) == bits_of(after.*channel.values), !of_compass)
        << channel.name;
  }
}

TEST(Synthesise, MotionMovesGyroAndHeadingByItselfAlone) {
  auto scenario = busy();
  scenario.compass.noise_std_deg = 0.0;
  scenario.compass.disturbances.clear();
  const auto moving = synthesised(scenario);
  scenario.motion = motion::Stationary{};
  const auto still = synthesised(scenario);
  double heading = 0.0;
  for (std::size_t i = 0; i < still.size(); ++i) {
    EXPECT_NEAR(moving.gyro_dps[i] - still.gyro_dps[i], moving.rate_ref_dps[i], 1e-12);
    if (i > 0) heading += moving.rate_ref_dps[i] * (moving.t_s[i] - moving.t_s[i - 1]);
    EXPECT_NEAR(wrap_degrees(moving.heading_deg[i] - heading - still.heading_deg[i]), 0.0, 1e-9);
  }
  EXPECT_EQ(bits_of(moving.random_error_dps), bits_of(still.random_error_dps));
}

TEST(Synthesise, TheWhiteNoiseIsTheSameAtAnyStrength) {
  auto scenario = busy();
  scenario.effects.clear();
  const auto with = [&](double std) {
    scenario.random_error.measurement_noise_std_dps = std;
    return synthesised(scenario).gyro_dps;
  };
  const auto none = with(0.0), once = with(0.1), thrice = with(0.3);
  for (std::size_t i = 0; i < none.size(); ++i)
    EXPECT_NEAR(thrice[i] - none[i], 3.0 * (once[i] - none[i]), 1e-12);
}

TEST(Synthesise, HasNoAccelerometerUnlessAsked) {
  auto scenario = busy();
  EXPECT_TRUE(synthesised(scenario).acc_x_mps2.empty());
  scenario.acceleration = acceleration::Tilting{};
  const auto series = synthesised(scenario);
  EXPECT_EQ(series.acc_x_mps2.size(), series.size());
  EXPECT_EQ(series.acc_z_mps2.size(), series.size());
  scenario.acceleration.reset();
  EXPECT_EQ(bits_of(series.gyro_dps), bits_of(synthesised(scenario).gyro_dps));
}

TEST(Synthesise, TellsNoRateAboutAnotherAxisUnlessAsked) {
  auto scenario = busy();
  const auto without = synthesised(scenario);
  EXPECT_TRUE(without.cross_rate_1_dps.empty());
  scenario.cross_motion_2 = motion::Sinusoidal{.amplitude_dps = 30.0, .frequency_hz = 0.2};
  const auto with = synthesised(scenario);
  EXPECT_TRUE(with.cross_rate_1_dps.empty());
  ASSERT_EQ(with.cross_rate_2_dps.size(), with.size());
  const motion::Sinusoidal asked{.amplitude_dps = 30.0, .frequency_hz = 0.2};
  EXPECT_EQ(with.cross_rate_2_dps[77], asked(with.t_s[77]));
  EXPECT_EQ(bits_of(with.gyro_dps), bits_of(without.gyro_dps));
  EXPECT_EQ(bits_of(with.heading_deg), bits_of(without.heading_deg));
}

Series synthesised_under(const Scenario& scenario, const Series& conditions,
                         const Noise& noise = {1, 0}) {
  Series series;
  synthesise_under(scenario, conditions, noise, series);
  return series;
}

TEST(SynthesiseUnder, ItsOwnConditionsIsTheSameSignal) {
  auto scenario = busy();
  scenario.compass.disturbances.clear();
  scenario.acceleration = acceleration::Tilting{};
  scenario.cross_motion_1 = scenario.cross_motion_2 = motion::Sinusoidal{};
  const auto series = synthesised(scenario);
  EXPECT_TRUE(same_bits(synthesised_under(scenario, series), series));
}

TEST(SynthesiseUnder, AnothersSamplingAndProfilesPlayNoPart) {
  const auto conditions = synthesised(busy());
  auto other = busy();
  other.sampling = {.duration_s = 5.0, .rate_hz = 1.0};
  other.temperature = temperature::QuietRoom{};
  other.motion = motion::Stationary{};
  other.acceleration = acceleration::Level{};
  other.compass.disturbances.clear();
  EXPECT_TRUE(
      same_bits(synthesised_under(other, conditions), synthesised_under(busy(), conditions)));
}

TEST(SynthesiseUnder, UnevenTimesSlopeAndHeadingGoByTheIntervals) {
  Scenario scenario;
  scenario.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.0};
  scenario.thermal_drift = {.a_dps_per_C = 0.5, .b_dps_s_per_C = 2.0, .c_dps = 1.0};
  scenario.compass = {.noise_std_deg = 0.0, .initial_heading_deg = 90.0, .disturbances = {}};
  Series conditions;
  conditions.t_s = {100.0, 101.0, 105.0};
  conditions.temperature_C = {20.0, 21.0, 29.0};
  conditions.rate_ref_dps = {0.0, 3.0, -1.0};
  conditions.heading_deg = {0.0, 0.0, 0.0};
  const auto series = synthesised_under(scenario, conditions);
  EXPECT_EQ(series.thermal_bias_dps, (std::vector<double>{13.0, 13.5, 19.5}));
  EXPECT_EQ(series.gyro_dps, (std::vector<double>{13.0, 16.5, 18.5}));
  EXPECT_EQ(series.heading_deg, (std::vector<double>{90.0, 93.0, 89.0}));
  EXPECT_TRUE(series.mag_valid.empty());
}

TEST(SynthesiseUnder, WithoutTemperatureTheDriftIsItsConstant) {
  Series conditions;
  conditions.t_s = {0.0, 1.0, 2.0};
  const auto series = synthesised_under(busy(), conditions);
  EXPECT_EQ(series.thermal_bias_dps, std::vector<double>(3, -0.05));
  EXPECT_EQ(series.rate_ref_dps, std::vector<double>(3, 0.0));
  EXPECT_TRUE(series.temperature_C.empty());
  EXPECT_TRUE(series.heading_deg.empty());
  EXPECT_TRUE(std::isfinite(series.gyro_dps[2]));
}

TEST(SynthesiseUnder, KeepsTheGapsAndFlagsOfTheRecording) {
  auto conditions = synthesised(busy());
  conditions.gyro_dps[3] = conditions.heading_deg[5] = conditions.temperature_C[7] = no_value;
  conditions.mag_valid[9] = 0.0;
  const auto series = synthesised_under(busy(), conditions);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(std::isnan(series.gyro_dps[i]), i == 3) << i;
    EXPECT_EQ(std::isnan(series.heading_deg[i]), i == 5) << i;
    EXPECT_EQ(std::isnan(series.temperature_C[i]), i == 7) << i;
    EXPECT_EQ(series.mag_valid[i], i == 9 ? 0.0 : 1.0) << i;
  }
  // The missing temperature is held.
  EXPECT_NEAR(series.thermal_bias_dps[7] - series.thermal_bias_dps[6],
              -0.3 * (series.temperature_C[6] - series.temperature_C[5]) / 0.05, 1e-12);
}

/// A rate turns fast enough to be cut for half of the time, and a filter rounds the corners of the
/// cut; cut behind the filter, it has them. The order of the effects says nothing.
TEST(Synthesise, CutsTheRateOnItsOwnSideOfAFilter) {
  const Effect filter = effects::SensorBandwidth{.cutoff_hz = 0.3};
  Scenario scenario;
  scenario.sampling = {.duration_s = 60.0, .rate_hz = 20.0};
  scenario.motion = motion::Sinusoidal{10.0 * std::sqrt(2.0), 0.5};
  scenario.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.0};
  scenario.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = 0.0};
  const auto sensed = [&](std::vector<Effect> effects) {
    scenario.effects = std::move(effects);
    return synthesised(scenario).gyro_dps;
  };
  auto cut_then_filtered = synthesised(scenario);
  for (double& rate : cut_then_filtered.rate_ref_dps) rate = std::clamp(rate, -10.0, 10.0);
  cut_then_filtered.gyro_dps = cut_then_filtered.rate_ref_dps;
  filter.apply(cut_then_filtered, {1, 0});
  auto filtered_then_cut = sensed({filter});
  for (double& rate : filtered_then_cut) rate = std::clamp(rate, -5.0, 5.0);

  const Effect before = effects::Saturation{.limit_dps = 10.0, .of_element = 2.0};
  const Effect behind = effects::Saturation{.limit_dps = 5.0, .of_element = 1.0};
  for (const bool filter_is_first : {true, false}) {
    const auto one = filter_is_first ? sensed({filter, before}) : sensed({before, filter});
    const auto other = filter_is_first ? sensed({filter, behind}) : sensed({behind, filter});
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_NEAR(one[i], cut_then_filtered.gyro_dps[i], 1e-12) << i;
      EXPECT_NEAR(other[i], filtered_then_cut[i], 1e-12) << i;
    }
  }
}

TEST(SynthesiseUnder, IgnoresTheScenariosDisturbances) {
  const auto conditions = synthesised(busy());
  auto quiet = busy();
  quiet.compass.disturbances.clear();
  EXPECT_TRUE(
      same_bits(synthesised_under(busy(), conditions), synthesised_under(quiet, conditions)));
}

}  // namespace
}  // namespace gyrostat::scenario_test
