#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/generators/random_error.hpp>
#include <gyrostat/tests/generators/noisy_series.hpp>

namespace gyrostat::noise_effects_test {
namespace {

// Every statistical tolerance here is 5 standard errors of a normal estimate: 6e-7 false failures
// each.

TEST(NoiseTemperature, MultipliesTheWhiteNoiseAndNothingElse) {
  const auto before = noisy(3000, 100.0);
  auto after = before;
  for (std::size_t i = 0; i < after.size(); ++i)
    after.temperature_C[i] = i < 1000 ? 40.0 : i < 2000 ? 90.0 : -60.0;
  effects::NoiseTemperature{.relative_per_C = 0.02, .reference_C = 40.0}.apply(after, {1, 0});
  const auto w = white_part(before), scaled = white_part(after);
  for (std::size_t i = 0; i < w.size(); ++i)
    EXPECT_NEAR(scaled[i], (i < 1000 ? 1.0 : i < 2000 ? 2.0 : 0.0) * w[i], 1e-13) << i;
}

// The mean square of n normals has relative standard error sqrt(2 / n).
TEST(NoiseTemperature, MayCurve) {
  auto series = silent(even_times(3, 100.0));
  series.temperature_C = {20.0, 30.0, 50.0};
  series.gyro_dps = {1.0, 1.0, 1.0};
  effects::NoiseTemperature{0.02, 30.0, 0.001}.apply(series, {1, 0});
  EXPECT_NEAR(series.gyro_dps[0], 1.0 - 0.2 + 0.1, 1e-12);
  EXPECT_EQ(series.gyro_dps[1], 1.0);
  EXPECT_NEAR(series.gyro_dps[2], 1.0 + 0.4 + 0.4, 1e-12);
}

TEST(NoiseTemperature, GivesTheStandardDeviationThatItStates) {
  constexpr std::size_t n = 100000;
  auto series = noisy(n, 100.0);
  std::fill(series.temperature_C.begin(), series.temperature_C.end(), 65.0);
  effects::NoiseTemperature{.relative_per_C = 0.01, .reference_C = 25.0}.apply(series, {1, 0});
  EXPECT_NEAR(mean_square(white_part(series)) / (0.28 * 0.28), 1.0, 5.0 * std::sqrt(2.0 / n));
}

// Of z = N(0, s^2) + hits: E z^2, E z^4 and E z^8 by the mixture; the error of a mean of z^k is
// sqrt((E z^2k - (E z^k)^2) / n).
TEST(Outliers, OnWhiteNoiseHaveTheVarianceAndKurtosisOfTheMixture) {
  constexpr std::size_t n = 500000;
  constexpr double p = 0.01, s2 = 0.04, hit2 = 0.36;
  auto series = silent(even_times(n, 100.0));
  add_white_noise(std::sqrt(s2), NormalStream(1, 0, "white_noise"), series.gyro_dps);
  effects::Outliers{.probability = p, .std_dps = std::sqrt(hit2)}.apply(series, {1, 0});
  const auto moment = [&](double normal_moment, int half) {
    return normal_moment * ((1.0 - p) * std::pow(s2, half) + p * std::pow(s2 + hit2, half));
  };
  double square = 0.0, fourth = 0.0;
  for (const double z : series.gyro_dps) {
    square += z * z / n;
    fourth += z * z * z * z / n;
  }
  const double m2 = moment(1, 1), m4 = moment(3, 2), m8 = moment(105, 4);
  EXPECT_NEAR(square, m2, 5.0 * std::sqrt((m4 - m2 * m2) / n));
  EXPECT_NEAR(fourth, m4, 5.0 * std::sqrt((m8 - m4 * m4) / n));
  EXPECT_GT(m4 / (m2 * m2), 4.5);  // where a normal has 3
}

/// Of one size, up as often as down: means of what was added to the samples that were hit.
TEST(Outliers, AboutASizeAreUpOrDownByIt) {
  constexpr std::size_t n = 100000;
  const auto hits = [&] {
    auto all = added(effects::Outliers{.probability = 0.1, .std_dps = 0.2, .mean_size_dps = 3.0},
                     even_times(n, 100.0));
    std::erase(all, 0.0);
    return all;
  }();
  const auto count = static_cast<double>(hits.size());
  EXPECT_NEAR(count / n, 0.1, 5.0 * std::sqrt(0.09 / n));
  double up = 0.0, size = 0.0, square = 0.0;
  for (const double hit : hits) {
    up += hit > 0.0 ? 1.0 : 0.0;
    size += std::abs(hit) / count;
    square += hit * hit / count;
  }
  EXPECT_NEAR(up / count, 0.5, 5.0 * 0.5 / std::sqrt(count));
  EXPECT_NEAR(size, 3.0, 5.0 * 0.2 / std::sqrt(count));
  EXPECT_NEAR(square - size * size, 0.04, 5.0 * 0.04 * std::sqrt(2.0 / count));
}

// Two-state chain with rates a = p and b = 1 / m: its share s = a / (a + b) has variance
// s (1 - s) (2 / (a + b) - 1) / n; a mean of r geometric lengths has variance m (m - 1) / r.
TEST(StaleSamples, RepeatTheirShareInRunsOfTheirMeanLength) {
  constexpr std::size_t n = 400000;
  for (const double m : {1.0, 4.0}) {
    constexpr double p = 0.02;
    auto series = silent(even_times(n, 100.0));
    add_white_noise(1.0, NormalStream(1, 0, "white_noise"), series.gyro_dps);
    const auto fresh = series.gyro_dps;
    effects::StaleSamples{.probability = p, .mean_run = m}.apply(series, {1, 0});
    double stale = 0.0, runs = 0.0;
    for (std::size_t i = 1; i < n; ++i) {
      const bool repeats = series.gyro_dps[i] == series.gyro_dps[i - 1];
      EXPECT_EQ(series.gyro_dps[i], repeats ? series.gyro_dps[i - 1] : fresh[i]);
      stale += repeats;
      runs += repeats && fresh[i - 1] == series.gyro_dps[i - 1];
    }
    const double share = p * m / (1.0 + p * m);
    const double variance = share * (1.0 - share) * (2.0 / (p + 1.0 / m) - 1.0) / n;
    EXPECT_NEAR(stale / n, share, 5.0 * std::sqrt(variance)) << "mean run " << m;
    EXPECT_NEAR(stale / runs, m, 5.0 * std::sqrt(m * (m - 1.0) / runs) + 1e-12) << "mean run " << m;
  }
}

/// Distances are 1 / p + 1 samples, 12 or 13 of them here, and no others.
TEST(StaleSamples, OfASlowerClockComeAtEvenDistances) {
  auto series = noisy(20000, 100.0);
  effects::StaleSamples{.probability = 1.0 / 11.4, .mean_run = 1.0, .regular = 1.0}.apply(series,
                                                                                          {1, 0});
  std::vector<std::size_t> at;
  for (std::size_t i = 1; i < series.size(); ++i)
    if (series.gyro_dps[i] == series.gyro_dps[i - 1]) at.push_back(i);
  EXPECT_NEAR(static_cast<double>(at.size()), 20000.0 / 12.4, 1.0);
  for (std::size_t k = 1; k < at.size(); ++k)
    EXPECT_EQ((at[k] - at[k - 1]) / 12, 1U) << at[k] - at[k - 1];
  for (std::size_t k = 1; k < at.size(); ++k) EXPECT_LE(at[k] - at[k - 1], 13U);
}

/// A recorder of R times the sensor's rate has a fresh value each R samples: of whole numbers all
/// runs are alike, of others they are of the two next to them.
TEST(StaleSamples, OfARecorderThatIsFasterFreshValuesComeEvenly) {
  for (const double ratio : {2.0, 3.0, 2.5, 5.3}) {
    auto series = noisy(20000, 100.0);
    effects::StaleSamples{.probability = 1.0, .mean_run = ratio - 1.0, .regular = 1.0}.apply(
        series, {1, 0});
    std::vector<std::size_t> at;
    for (std::size_t i = 1; i < series.size(); ++i)
      if (series.gyro_dps[i] != series.gyro_dps[i - 1]) at.push_back(i);
    EXPECT_NEAR(static_cast<double>(at.size()), 20000.0 / ratio, 1.0);
    for (std::size_t k = 1; k < at.size(); ++k) {
      const auto apart = static_cast<double>(at[k] - at[k - 1]);
      EXPECT_GE(apart, std::floor(ratio));
      EXPECT_LE(apart, std::ceil(ratio));
    }
  }
}

}  // namespace
}  // namespace gyrostat::noise_effects_test
