// Sets by likelihood: what values and their sizes say.

#include <gyrostat/diagnosis/likelihood/set_search.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/found_in.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::sets_of_values_test {
namespace {

/// Rates in steps of an angle's grid an interval lie on a grid themselves, and are not rounded.
TEST(SetSearch, AnAngleOnAGridIsOneEffect) {
  Scenario s = still(ten_minutes_s);
  s.effects = {effects::AngleQuantization{.coefficient_deg = 7e-4, .on_grid = 1.0}};
  EXPECT_EQ(found_in(recorded(s, 79, false)), std::set<std::string>{"angle_quantization"});
  s.effects = {effects::Quantization{0.05}};
  EXPECT_EQ(found_in(recorded(s, 79, false)), std::set<std::string>{"quantization"});
}

/// Half of the neighbours on a grid of two deviations are equal by chance. Without all of them the
/// noise had another colour, and a repeat at the turn of the table, 60 dps off, was in R.
TEST(SetSearch, RepeatsBesideACoarseGridColourNoNoise) {
  Scenario s = moving(ten_minutes_s);
  s.motion = motion::RateTable{60.0, 8.0};
  s.effects = {effects::ScaleFactor{0.01}, effects::StaleSamples{0.05, 1.0},
               effects::Quantization{0.1}};
  const auto series = recorded(s, 89, true);
  const Simulator simulator(series, 1);
  const auto found = find_set(simulator, series, {});
  std::set<std::string> names;
  for (const auto& member : found.members) names.insert(member.effect);
  EXPECT_EQ(names, (std::set<std::string>{"quantization", "scale_factor", "stale_samples"}));
  EXPECT_NEAR(found.scenario.random_error.measurement_noise_std_dps, 0.05, 0.005);
}

/// On a grid of almost the noise a repeat is seen only where the motion went on, by three
/// deviations as by ten: those between were outliers of four.
TEST(SetSearch, RepeatsThatAMotionHardlyTellsAreNoOutliers) {
  Scenario s = moving(ten_minutes_s);
  s.motion = motion::Sinusoidal{80.0, 0.031};
  s.effects = {effects::StaleSamples{0.01, 1.0}, effects::Quantization{0.04}};
  for (const std::uint64_t seed : {91, 92})
    EXPECT_EQ(found_in(recorded(s, seed, true)),
              (std::set<std::string>{"quantization", "stale_samples"}))
        << seed;
}

/// What is added behind a filter warms with what has passed it, and only an error of rounding does
/// not. Of 12,000 samples a slope is known to 0.0006 a degree; four times that is allowed.
TEST(SetSearch, NoiseBehindAFilterWarmsAsThatBeforeIt) {
  Scenario s = still();
  s.effects = {effects::NoiseBandwidth{
                   .cutoff_hz = 5.0, .poles = 2.0, .maximally_flat = 1.0, .after_dps = 0.035},
               effects::NoiseTemperature{.relative_per_C = 0.01, .reference_C = 40.0}};
  const auto series = recorded(s, 61, false);
  const auto found = find_set(Simulator(series, 1), series, {});
  std::set<std::string> names;
  for (const auto& member : found.members) names.insert(member.effect);
  ASSERT_EQ(names, (std::set<std::string>{"noise_bandwidth", "noise_temperature"}));
  for (const auto& effect : found.scenario.effects)
    if (const auto* warm = effect.as<effects::NoiseTemperature>()) {
      // As it would be at the reference that was chosen.
      const double there = 1.0 + 0.01 * (warm->reference_C - 40.0);
      EXPECT_NEAR(warm->relative_per_C * there, 0.01, 0.0024);
    }
}

/// Where a filter of the rate is found first, no outlier has been told before the line has: they
/// were bursts of it in six of six recordings.
TEST(SetSearch, OutliersBesideALineAreNoBurstsOfIt) {
  Scenario s = moving(ten_minutes_s);
  s.effects = {effects::SensorBandwidth{.cutoff_hz = 1.0}, effects::Vibration{0.04, 4.0, 0.4},
               effects::Outliers{0.005, 0.5}};
  for (const std::uint64_t seed : {62, 63})
    EXPECT_EQ(found_in(recorded(s, seed, true)),
              (std::set<std::string>{"outliers", "sensor_bandwidth", "vibration"}))
        << seed;
}

/// Of 1,200 outliers on a grid some eighty fall on the value before, and as many on each beside it.
TEST(SetSearch, OutliersThatFallOnTheValueBeforeAreNoRepeats) {
  Scenario s = moving();
  s.effects = {effects::Outliers{.probability = 0.05, .std_dps = 0.5}, effects::Quantization{0.1}};
  EXPECT_EQ(found_in(recorded(s, 90, true)), (std::set<std::string>{"outliers", "quantization"}));
}

/// Noise that warms and heavy tails make as many neighbours on a coarse grid differ by two steps as
/// if many of the equal ones were repeated; but many more differ by three, too.
TEST(SetSearch, TailsOnACoarseGridAreNoRepeats) {
  Scenario s = still();
  s.effects = {effects::NoiseTemperature{0.02, 38.0, 5e-4}, effects::Outliers{0.015, 0.44},
               effects::Quantization{0.1}};
  EXPECT_EQ(found_in(recorded(s, 90, false)).count("stale_samples"), 0U);
}

/// Gross errors of about one size; the size is known to 0.01 dps, and 5 of that are allowed.
TEST(SetSearch, OutliersMayHaveASize) {
  Scenario s = still();
  s.effects = {effects::Outliers{.probability = 0.01, .std_dps = 0.06, .mean_size_dps = 0.4}};
  const auto series = recorded(s, 80, false);
  const Simulator simulator(series, 1);
  const auto found = find_set(simulator, series, {});
  ASSERT_EQ(found.scenario.effects.size(), 1);
  ASSERT_EQ(found.scenario.effects[0].id(), "outliers");
  const auto& outliers = *found.scenario.effects[0].as<effects::Outliers>();
  EXPECT_NEAR(outliers.mean_size_dps, 0.4, 0.05);
  EXPECT_NEAR(outliers.probability, 0.01, 5.0 * std::sqrt(0.01 / 24000.0));
}

/// White noise, a common kind of errors and a rare one. Deviations are known to one over the root
/// of twice the samples that have them, times at most 1.5 for not knowing which; 5 times that is
/// allowed. At least half the samples are of the part that is fitted.
TEST(SetSearch, OutliersMayBeOfTwoKinds) {
  Scenario s = still();
  const effects::Outliers common{.probability = 0.4, .std_dps = 0.2},
      rare{.probability = 0.002, .std_dps = 2.0};
  s.effects = {common, rare};
  const auto series = recorded(s, 82, false);
  const Simulator simulator(series, 1);
  const auto found = find_set(simulator, series, {});
  ASSERT_EQ(found.members.size(), 1);
  ASSERT_EQ(found.members[0].effect, "outliers");
  ASSERT_EQ(found.scenario.effects.size(), 2);
  const double counted = 0.5 * static_cast<double>(series.size());
  const auto share_known = [&](double share) { return 7.5 / std::sqrt(2.0 * share * counted); };
  const double white = s.random_error.measurement_noise_std_dps;
  // The level of some seconds, which is taken out, has of the errors, too.
  constexpr double of_the_level = 0.05;
  EXPECT_NEAR(found.scenario.random_error.measurement_noise_std_dps / white, 1.0,
              of_the_level + share_known(1.0 - common.probability));
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& truth = k == 0 ? rare : common;
    const auto& seen = *found.scenario.effects[k].as<effects::Outliers>();
    EXPECT_NEAR(seen.std_dps / truth.std_dps, 1.0, share_known(truth.probability));
    EXPECT_NEAR(seen.probability / truth.probability, 1.0,
                7.5 / std::sqrt(truth.probability * counted));
  }
}

/// Rounded to 1.7 of its standard deviations, noise goes with where the level is between two
/// values, and temperature moves the level; that it grows with temperature shows all the same.
TEST(SetSearch, NoiseThatWarmsAndOutliersAreSeenThroughACoarseGrid) {
  Scenario s = still(ten_minutes_s);
  s.random_error = {
      .phi = 0.0, .delta1_dps = 1e-5, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.05};
  s.thermal_drift.a_dps_per_C = 0.01;
  s.effects = {effects::Quantization{0.1}};
  EXPECT_EQ(found_in(recorded(s, 81, false)), std::set<std::string>{"quantization"});
  s.effects.emplace_back(effects::NoiseTemperature{.relative_per_C = 0.015, .reference_C = 40.0});
  EXPECT_EQ(found_in(recorded(s, 81, false)),
            (std::set<std::string>{"noise_temperature", "quantization"}));
  s.effects.back() = effects::Outliers{.probability = 0.003, .std_dps = 0.5};
  EXPECT_EQ(found_in(recorded(s, 81, false)), (std::set<std::string>{"outliers", "quantization"}));
}

/// Noise that grows by a half over the ramp: what is stated is that of its reference temperature,
/// not the mean of all, which is 7 % more. Its standard error is 0.5 %, of five of them one test in
/// 1.7 million fails.
TEST(SetSearch, NoiseThatWarmsIsStatedAtItsReference) {
  Scenario s = still();
  s.effects = {effects::NoiseTemperature{.relative_per_C = 0.03, .reference_C = 40.0}};
  for (const bool outliers : {false, true}) {
    if (outliers) s.effects.emplace_back(effects::Outliers{.probability = 0.003, .std_dps = 0.5});
    const Series recording = recorded(s, 83, false);
    const auto found = find_set(Simulator(recording, 1), recording, {}).scenario;
    const auto warm = std::find_if(found.effects.begin(), found.effects.end(),
                                   [](const auto& e) { return e.id() == "noise_temperature"; });
    ASSERT_NE(warm, found.effects.end());
    const double off_C = warm->value(field_of(*warm, "reference_C")) - 40.0;
    EXPECT_NEAR(found.random_error.measurement_noise_std_dps / (1.0 + 0.03 * off_C), 0.05,
                5.0 * 0.005 * 0.05);
  }
}

/// Under a motion that is not yet explained a walk stands in for the noise, and a grid that is
/// small to it looked coarse: nothing was sought in the noise.
TEST(SetSearch, AGridBelowTheNoiseIsNotCoarseUnderAMotion) {
  Scenario s = moving(ten_minutes_s);
  s.effects = {effects::ScaleFactor{0.05}, effects::Quantization{0.02},
               effects::NoiseBandwidth{.cutoff_hz = 4.0}};
  EXPECT_EQ(found_in(recorded(s, 46, true)),
            (std::set<std::string>{"noise_bandwidth", "quantization", "scale_factor"}));
}

/// Beside noise that remembers a walk stood in for it, and a grid of one and a half of its
/// deviations looked coarse: the filter was not sought.
TEST(SetSearch, AGridBelowTheNoiseIsNotCoarseBesideNoiseThatRemembers) {
  Scenario s = still();
  s.effects = {effects::NoiseBandwidth{.cutoff_hz = 0.9}, effects::Quantization{0.03}};
  EXPECT_EQ(found_in(recorded(s, 49, false)),
            (std::set<std::string>{"noise_bandwidth", "quantization"}));
}

}  // namespace
}  // namespace gyrostat::gap::sets_of_values_test
