// Sets by likelihood: lines, and what an accelerometer feels.

#include <gyrostat/diagnosis/likelihood/set_search.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/generators/environment/acceleration/list.hpp>
#include <gyrostat/tests/diagnosis/found_in.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::sets_of_vibration_test {
namespace {

/// The accelerometer tells the strength of the vibration to a few percent only; the bias follows
/// the strength itself.
TEST(SetSearch, ABiasThatFollowsAShakerIsNoStep) {
  Series series = recorded(still(ten_minutes_s), 78, false);
  const NormalStream noise(78, 0, "shaker");
  constexpr std::array strengths = {2.0, 0.0, 5.0, 3.0, 4.0, 1.0, 0.0, 4.5};
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double strength = strengths[i * strengths.size() / series.size()];
    series.acc_x_mps2.push_back(strength * noise.normal(3 * i));
    series.acc_y_mps2.push_back(strength * noise.normal(3 * i + 1));
    series.acc_z_mps2.push_back(9.81 + strength * noise.normal(3 * i + 2));
    series.gyro_dps[i] += 0.001 * strength * strength;
  }
  EXPECT_EQ(found_in(series), std::set<std::string>{"vibration_rectification"});
}

/// A line that wanders by less than the spectrum resolves, beside a grid: an MPU6050's z axis.
TEST(SetSearch, NamesALineThatWandersLittle) {
  Scenario s = still();
  s.sampling = {600.0, 100.0};
  s.effects = {effects::WanderingLine{.amplitude_dps = 0.085,
                                      .frequency_hz = 31.4,
                                      .wander_hz = 0.16,
                                      .correlation_time_s = 3.0},
               effects::Quantization{0.0076}};
  EXPECT_EQ(found_in(recorded(s, 5, false)),
            (std::set<std::string>{"quantization", "wandering_line"}));
}

/// Taken out sample by sample, an accelerometer's own noise, 0.09 m/s^2 times 0.06 dps/(m/s^2),
/// would be a ninth of the gyro's: 12,000 half squares of it, 130 nats, which every further effect
/// would have had to gain first.
TEST(SetSearch, AnAccelerometersOwnNoiseIsNotFelt) {
  Scenario s = still();
  Series series = recorded(s, 83, false);
  const std::size_t n = series.size();
  std::vector<double> noise(3 * n);
  NormalStream(83, 0, "accelerometer").fill(0, noise);
  for (auto channel : {&Series::acc_x_mps2, &Series::acc_y_mps2, &Series::acc_z_mps2})
    (series.*channel).resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double along_x = 4.0 * std::sin(0.05 * series.t_s[i]);
    series.acc_x_mps2[i] = along_x + 0.09 * noise[3 * i];
    series.acc_y_mps2[i] = 0.09 * noise[3 * i + 1];
    series.acc_z_mps2[i] = 9.81 + 0.09 * noise[3 * i + 2];
    series.gyro_dps[i] += 0.06 * along_x;
  }
  const Simulator simulator(series, 1);
  const SetBench bench(simulator, series, {});
  const auto none = bench.beside_noise({});
  const auto left = bench.evidence_of(none);
  const auto felt = bench.with(none, cause_types().named("g_sensitivity", "effects"), &left);
  EXPECT_GT(felt.score, none.score + 100.0);
  EXPECT_GT(bench.refitted(felt.scenario).score, felt.score - 10.0);
}

/// As a fit leaves it along an axis that does not feel the shaker.
TEST(SetSearch, OfAShakerNothingIsFeltWithoutASize) {
  Series series = recorded(still(), 84, false);
  for (auto channel : {&Series::acc_x_mps2, &Series::acc_y_mps2, &Series::acc_z_mps2})
    (series.*channel).assign(series.size(), 0.0);
  for (std::size_t i = 0; i < series.size(); ++i)
    series.acc_x_mps2[i] = 3.0 * std::sin(20.0 * series.t_s[i]);
  const Simulator simulator(series, 1);
  const SetBench bench(simulator, series, {});
  auto scenario = bench.beside_noise({}).scenario;
  const std::vector<char> all(series.size(), 0);
  const auto without = bench.rate_left_by(scenario, all);
  scenario.effects = {effects::GSensitivity{0.0, 0.0, 0.0}};
  EXPECT_EQ(bench.rate_left_by(scenario, all), without);
}

/// A building sways at tenths of a hertz, below what spectra of samples are asked for. White to
/// cluster means, such lines were averages, filters or slow noise.
TEST(SetSearch, LinesOfTenthsOfAHertzHaveTheirNames) {
  const std::vector<Effect> lines = {effects::Vibration{0.02, 0.4, 0.1},
                                     effects::Vibration{0.02, 0.12, 0.03},
                                     effects::WanderingLine{0.02, 0.5, 0.05, 5.0}};
  for (const auto& line : lines) {
    Scenario s = still();
    s.effects = {line};
    EXPECT_EQ(found_in(recorded(s, 85, false)), std::set<std::string>{std::string(line.id())});
  }
}

/// Where noise in a band is not in the catalogue, it is no line that wanders.
TEST(SetSearch, NoiseInABandHasNoOtherName) {
  Scenario s = still(ten_minutes_s);
  s.effects = {effects::Vibration{0.04, 4.0, 0.4}};
  const auto series = recorded(s, 77, false);
  const Simulator simulator(series, 1);
  SetSearchOptions options;
  options.without = {"vibration"};
  const auto found = find_set(simulator, series, options);
  for (const auto& member : found.members) EXPECT_NE(member.effect, "wandering_line");
  EXPECT_GT(found.nameless_log_odds, 0.0);
}

/// A line of 36 nats in the train part is in no bin of the averaged spectrum.
TEST(SetSearch, AFaintSineIsFoundAmongAllSamples) {
  Scenario s = still();
  s.sampling = {3600.0, 50.0};
  s.effects = {effects::Sinusoidal{.amplitude_dps = 2e-3, .frequency_hz = 7.3131}};
  EXPECT_EQ(found_in(recorded(s, 44, false)), std::set<std::string>{"sinusoidal"});
}

/// A telephone that rings for two minutes: a sine for one second of three, 13 nats each of the 40
/// times, which in the mean spectrum of 15 minutes are a fifth of the noise of one bin.
TEST(SetSearch, ALineThatIsThereForMinutesIsFound) {
  Series series = recorded(still(), 50, false);
  for (std::size_t i = 2000; i < 4400; ++i)
    if (i % 60 < 20)
      series.gyro_dps[i] += 0.08 * std::sin(2.0 * std::numbers::pi * 6.3 * series.t_s[i]);
  EXPECT_EQ(found_in(series), std::set<std::string>{"vibration_bursts"});
}

/// What a shaker does to a gyro that feels acceleration is within a cluster of samples, too, and no
/// line besides.
TEST(SetSearch, AShakerThatIsFeltIsNoVibration) {
  Scenario s = still();
  s.acceleration = acceleration::Shaking{.amplitude_mps2 = 5.0, .frequency_hz = 4.3};
  s.effects = {effects::GSensitivity{.x_dps_per_mps2 = 0.0, .z_dps_per_mps2 = 0.02}};
  Series series = recorded(s, 53, false);
  // And it stands on one edge, then on another.
  for (std::size_t i = series.size() / 3; i < 2 * series.size() / 3; ++i) {
    series.acc_z_mps2[i] -= 9.8;
    series.gyro_dps[i] -= 9.8 * 0.02;
  }
  EXPECT_EQ(found_in(series), std::set<std::string>{"g_sensitivity"});
}

/// As of a pump that runs for some seconds now and then, from one motor: it was a vibration beside
/// a sine. Where both are there all the time they are two effects, though the sine be a fifth of
/// the vibration's power: its peak is 38 nats above those beside it.
TEST(SetSearch, ASineThatIsGatedIsBursts) {
  for (const bool is_gated : {true, false}) {
    Scenario s = still();
    s.effects = {effects::Vibration{.std_dps = 0.02, .centre_hz = 4.7, .bandwidth_hz = 0.3}};
    Series series = recorded(is_gated ? still() : s, 53, false);
    const NormalStream chance(54, 0, "gates");
    std::uint64_t gates = 0;
    double until_s = 0.0;
    bool is_on = false;
    for (std::size_t i = 0; i < series.size(); ++i) {
      const double t_s = series.t_s[i];
      if (t_s >= until_s) {
        is_on = !is_on;
        until_s += (is_on ? 3.0 : 12.0) * (0.5 + chance.uniform(gates++));
      }
      if (is_on || !is_gated)
        series.gyro_dps[i] +=
            (is_gated ? 0.05 : 0.012) * std::sin(2.0 * std::numbers::pi * 4.7 * t_s);
    }
    EXPECT_EQ(found_in(series), is_gated ? (std::set<std::string>{"vibration_bursts"})
                                         : (std::set<std::string>{"sinusoidal", "vibration"}));
  }
}

}  // namespace
}  // namespace gyrostat::gap::sets_of_vibration_test
