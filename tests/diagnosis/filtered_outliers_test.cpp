// Outliers on either side of what colours the noise.

#include <gyrostat/diagnosis/likelihood/tails.hpp>

#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/diagnosis/likelihood/noise_over.hpp>
#include <gyrostat/diagnosis/likelihood/set_search.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/tests/diagnosis/found_in.hpp>
#include <gyrostat/tests/diagnosis/known_recordings.hpp>

namespace gyrostat::gap::filtered_outliers_test {
namespace {

constexpr double pole = 0.9;
constexpr std::size_t between = 240;  ///< samples from one hit to the next

/// White noise through a pole, and ten minutes of conditions for it.
struct Coloured {
  Series series = recorded(still(ten_minutes_s), 1, false);
  Conditions conditions{series};
  std::vector<double> passed, behind;

  /// One hit every so often, of eight deviations of the white noise, up and down.
  Coloured() {
    const NormalStream white(5, 0, "white");
    std::vector<double> noise(series.size());
    white.fill(0, noise);
    double before = 0.0, without = 0.0;
    for (std::size_t i = 0; i < series.size(); ++i) {
      const double hit = i % between != between / 2 ? 0.0 : i / between % 2 == 0 ? 8.0 : -8.0;
      passed.push_back(before = pole * before + noise[i] + hit);
      without = pole * without + noise[i];
      behind.push_back(without + hit);
    }
  }
};

/// Noise of its own, of which one sample in 60,000 is as far off, is allowed five.
TEST(Tails, FlagWhatIsBehindAFilterAndNotWhatFollows) {
  const Coloured made;
  const auto tails = tails_of(made.conditions, made.behind, false, Past::may_be_of_outliers);
  EXPECT_FALSE(tails.innovational);
  std::size_t hits = 0, others = 0;
  for (std::size_t i = 0; i < tails.outliers.size(); ++i)
    if (tails.outliers[i] != 0) ++(i % between == between / 2 ? hits : others);
  EXPECT_EQ(hits, made.series.size() / between);
  EXPECT_LE(others, 5U);
}

/// An innovation of the deviation that noise has before its filter, and hits of eight of it. Of at
/// least half of 50 hits the share is known to 20 %; five times that is allowed.
TEST(Tails, TellWhatPassesAFilter) {
  const Coloured made;
  const auto tails = tails_of(made.conditions, made.passed, false, Past::may_be_of_outliers);
  EXPECT_TRUE(tails.innovational);
  EXPECT_NEAR(tails.deviation, 1.0, 0.05);
  ASSERT_FALSE(tails.populations.empty());
  EXPECT_NEAR(tails.populations[0].probability * between, 1.0, 1.0);
  EXPECT_FALSE(tails_of(made.conditions, made.passed, false).innovational);
}

/// Four samples in ten are four times as wide: by chance a slope gains half a unit of the
/// logarithm, of 40 draws with a standard error of 0.11, and five of these are allowed.
TEST(NoiseOver, OfManyWideOnesIsEven) {
  constexpr std::size_t samples = 12000;
  constexpr int draws = 40;
  std::vector<double> off_C(samples), noise(samples);
  for (std::size_t i = 0; i < samples; ++i)
    off_C[i] = 17.0 * std::sin(1e-3 * static_cast<double>(i));
  double gain = 0.0;
  for (std::uint32_t trial = 0; trial < draws; ++trial) {
    const NormalStream white(5, trial, "white"), wide(5, trial, "wide");
    white.fill(0, noise);
    for (std::size_t i = 0; i < samples; ++i)
      if (wide.uniform(i) < 0.4) noise[i] *= 4.0;
    gain += noise_over(off_C, noise, 1.5, 4.0).gain / draws;
  }
  EXPECT_LT(gain, 0.5 + 5.0 * 0.11);
}

/// Cut at five deviations of the noise, each was many innovations, and the answer `unknown`.
TEST(SetSearch, OutliersBehindAnAverageAreNoPartOfIt) {
  Scenario s = still(ten_minutes_s);
  const effects::Outliers outliers{.probability = 0.004, .std_dps = 0.3};
  s.effects = {effects::NoiseAveraging{.length = 4.0}, outliers};
  const auto series = recorded(s, 101, false);
  const auto found = find_set(Simulator(series, 1), series, {});
  std::set<std::string> names;
  for (const auto& member : found.members) names.insert(member.effect);
  EXPECT_EQ(names, (std::set<std::string>{"noise_averaging", "outliers"}));
  const auto& seen = *found.scenario.effects.back().as<effects::Outliers>();
  EXPECT_EQ(seen.before_filter, 0.0);
  EXPECT_NEAR(seen.std_dps / outliers.std_dps, 1.0, 0.5);
}

/// Of some fifty hits at least half are fitted: their deviation is known to 15 %, their share to
/// 20 %, and three times that is allowed.
TEST(SetSearch, OutliersBeforeAFilterPassIt) {
  const effects::Outliers outliers{.probability = 0.004, .std_dps = 0.5, .before_filter = 1.0};
  const effects::NoiseBandwidth one{.cutoff_hz = 3.0}, two{.cutoff_hz = 2.0, .poles = 2.0};
  for (const auto& filter : {one, two}) {
    Scenario s = still(ten_minutes_s);
    s.effects = {outliers, filter};
    const auto series = recorded(s, 103, false);
    const auto found = find_set(Simulator(series, 1), series, {});
    std::set<std::string> names;
    for (const auto& member : found.members) names.insert(member.effect);
    EXPECT_EQ(names, (std::set<std::string>{"noise_bandwidth", "outliers"})) << filter.poles;
    ASSERT_EQ(found.scenario.effects.front().id(), "outliers");
    const auto& seen = *found.scenario.effects.front().as<effects::Outliers>();
    EXPECT_EQ(seen.before_filter, 1.0);
    EXPECT_NEAR(seen.std_dps / outliers.std_dps, 1.0, 0.5);
    EXPECT_NEAR(seen.probability / outliers.probability, 1.0, 0.6);
    EXPECT_NEAR(found.scenario.random_error.measurement_noise_std_dps, 0.05, 0.005);
  }
}

}  // namespace
}  // namespace gyrostat::gap::filtered_outliers_test
