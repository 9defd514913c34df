// Nameless parts that are estimated against replicas: each closes what it is for, on truths of
// which it has not the form, and is not there where nothing is left.

#include <gyrostat/diagnosis/remainder/remainder.hpp>

#include <cmath>

#include <gmock/gmock.h>

#include <gyrostat/diagnosis/remainder/compass_tails.hpp>
#include <gyrostat/diagnosis/remainder/distribution.hpp>
#include <gyrostat/diagnosis/remainder/filter.hpp>
#include <gyrostat/diagnosis/remainder/noise_over_rate.hpp>
#include <gyrostat/diagnosis/remainder/wander.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::remainder_test {
namespace {

Scenario with(Scenario scenario, const Effect& effect) {
  scenario.effects.push_back(effect);
  return scenario;
}

/// A recording of a truth, and the simulator that lacks something of it.
struct Case {
  Series recording;
  Simulator simulator;
  Scenario lacking;

  Case(const Scenario& truth, const Scenario& simulated, std::uint64_t seed, bool with_rate = false)
      : recording(recorded(truth, seed, with_rate)), simulator(recording, 1), lacking(simulated) {}

  const Conditions& conditions() const { return simulator.conditions(); }
  Replicated beside(const std::vector<Nameless>& parts = {}) const {
    return Replicated(simulator, recording, with_nameless(lacking, parts));
  }
};

double value_of(const Effect& effect, std::string_view name) {
  for (std::size_t f = 0; f < effect.fields().size(); ++f)
    if (effect.fields()[f].name == name) return effect.value(f);
  return no_value;
}

/// Each part has a chance of at most one in a thousand, and there are thirty.
TEST(Remainder, IsNothingBesideReplicasOfTheTruth) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Case turning(moving(), moving(), seed, true);
    const auto beside = turning.beside();
    EXPECT_FALSE(distribution_part(beside)) << seed;
    EXPECT_FALSE(filter_part(beside, turning.conditions().rate_hz())) << seed;
    EXPECT_FALSE(noise_over_rate_part(turning.conditions(), beside)) << seed;
    EXPECT_FALSE(rate_wander_part(turning.conditions(), beside)) << seed;
    EXPECT_FALSE(compass_wander_part(turning.conditions(), beside)) << seed;
    EXPECT_FALSE(compass_tails_part(turning.conditions(), beside, turning.lacking)) << seed;
  }
}

/// What is beside it once more is what is beside replicas of the truth: nothing.
TEST(Remainder, AFilterAddsAndTakesAwayASpectrum) {
  const Scenario filtered = with(still(), effects::NoiseBandwidth{.cutoff_hz = 4.0});
  const Scenario shaken =
      with(still(), effects::Vibration{.std_dps = 0.03, .centre_hz = 6.0, .bandwidth_hz = 3.0});
  for (const auto& [truth, simulated] : {std::pair{filtered, still()}, std::pair{still(), filtered},
                                         std::pair{shaken, still()}, std::pair{still(), shaken}}) {
    const Case c(truth, simulated, 3);
    const auto part = filter_part(c.beside(), c.conditions().rate_hz());
    ASSERT_TRUE(part);
    EXPECT_FALSE(filter_part(c.beside({*part}), c.conditions().rate_hz())) << part->in_words;
  }
}

TEST(Remainder, ADistributionMakesTailsHeavierAndLighter) {
  const Scenario rare = with(still(), effects::Outliers{.probability = 0.005, .std_dps = 0.5});
  const Scenario wide = with(still(), effects::Outliers{.probability = 0.3, .std_dps = 0.1});
  for (const auto& [truth, simulated] : {std::pair{rare, still()}, std::pair{wide, still()},
                                         std::pair{still(), wide}, std::pair{rare, wide}}) {
    const Case c(truth, simulated, 5);
    const auto part = distribution_part(c.beside());
    ASSERT_TRUE(part);
    EXPECT_FALSE(distribution_part(c.beside({*part}))) << part->in_words;
  }
}

/// A wander over 20 s has 45 independent values in 900 s: its standard deviation is known to a
/// tenth; within four of those.
TEST(Remainder, AWanderHasTheSizeOfTheSurplus) {
  Scenario truth = still();
  truth.random_error.delta1_dps = truth.random_error.delta2_dps = 0.0;
  const Scenario simulated = truth;
  truth.effects = {effects::GaussMarkov{.std_dps = 0.02, .correlation_time_s = 20.0},
                   effects::EmpiricalCompassWander{.std_deg = 0.15, .time_s = 20.0}};
  const Case c(truth, simulated, 4);
  const auto beside = c.beside();
  const auto rate = rate_wander_part(c.conditions(), beside);
  const auto compass = compass_wander_part(c.conditions(), beside);
  ASSERT_TRUE(rate);
  ASSERT_TRUE(compass);
  EXPECT_NEAR(value_of(rate->effect, "std_dps"), 0.02, 0.4 * 0.02);
  EXPECT_NEAR(value_of(compass->effect, "std_deg"), 0.15, 0.4 * 0.15);
  const auto again = c.beside({*rate, *compass});
  EXPECT_FALSE(rate_wander_part(c.conditions(), again));
  EXPECT_FALSE(compass_wander_part(c.conditions(), again));
}

/// On the average of eight recordings, within five of its standard errors.
TEST(Remainder, TailsOfTheCompassAreAsHeavyAsTheTruths) {
  constexpr double tail = 0.5;
  Scenario truth = still();
  truth.compass.noise_std_deg = 0.0;
  truth.effects = {effects::EmpiricalCompassNoise{
      .innovation_std_deg = 0.3, .reflection_1 = -0.4, .tail = tail}};
  Scenario simulated = truth;
  simulated.effects = {
      effects::EmpiricalCompassNoise{.innovation_std_deg = 0.3, .reflection_1 = -0.4}};
  double sum = 0.0, squares = 0.0;
  constexpr int recordings = 8;
  for (std::uint64_t seed = 1; seed <= recordings; ++seed) {
    const Case c(truth, simulated, seed);
    const auto part = compass_tails_part(c.conditions(), c.beside(), simulated);
    ASSERT_TRUE(part) << seed;
    const double found = value_of(part->effect, "tail");
    sum += found / recordings;
    squares += found * found / recordings;
    EXPECT_EQ(value_of(part->effect, "reflection_1"), -0.4);
  }
  EXPECT_NEAR(sum, tail, 5.0 * std::sqrt((squares - sum * sum) / (recordings - 1)));
}

/// Of a knot with a few thousand steps the size is known to a fiftieth; within five of those.
TEST(Remainder, NoiseOverRateIsTheGainOfEachRate) {
  const effects::EmpiricalNoiseOverRate grown{
      .fastest_dps = 80.0, .gain_6 = 1.2, .gain_7 = 1.6, .gain_8 = 2.5};
  const Case c(with(moving(), grown), moving(), 6, true);
  const auto part = noise_over_rate_part(c.conditions(), c.beside());
  ASSERT_TRUE(part);
  EXPECT_NEAR(value_of(part->effect, "gain_8"), 2.5, 0.25);
  EXPECT_NEAR(value_of(part->effect, "gain_6"), 1.2, 0.12);
  // A straight line between knots is not the mean over what lies about each.
  if (const auto again = noise_over_rate_part(c.conditions(), c.beside({*part}))) {
    for (const auto* gain : {"gain_4", "gain_5", "gain_6", "gain_7", "gain_8"})
      EXPECT_NEAR(value_of(again->effect, gain), 1.0, 0.1) << gain;
  }
}

/// What changes all errors stands before the grid that the converter puts them on.
TEST(Remainder, StandsBeforeTheConverter) {
  const Scenario coarse = with(still(), effects::Quantization{.lsb_dps = 0.02});
  const auto scenario =
      with_nameless(coarse, {{effects::EmpiricalFilter{}, ""}, {effects::EmpiricalWander{}, ""}});
  std::vector<std::string> ids;
  for (const auto& effect : scenario.effects) ids.emplace_back(effect.id());
  EXPECT_THAT(ids, testing::ElementsAre("empirical_filter", "quantization", "empirical_wander"));
}

/// Where each part is worth having; where none is, none is there.
TEST(Remainder, IsMadeOfWhatReplicasLack) {
  const Scenario truth = with(with(still(), effects::NoiseBandwidth{.cutoff_hz = 4.0}),
                              effects::Outliers{.probability = 0.005, .std_dps = 0.5});
  const Case c(truth, still(), 7);
  const auto parts = with_what_replicas_lack(
      c.simulator, c.recording, c.lacking, {},
      [](const auto& so_far) { return static_cast<double>(so_far.size()); });
  std::vector<std::string> ids;
  for (const auto& part : parts) ids.emplace_back(part.effect.id());
  EXPECT_THAT(ids, testing::ElementsAre("empirical_filter", "empirical_distribution"));
  EXPECT_TRUE(with_what_replicas_lack(c.simulator, c.recording, c.lacking, {}, [](const auto&) {
                return 0.0;
              }).empty());
}

}  // namespace
}  // namespace gyrostat::gap::remainder_test
