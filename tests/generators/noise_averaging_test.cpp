#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/tests/generators/noisy_series.hpp>

namespace gyrostat::noise_averaging_test {
namespace {

// Every statistical tolerance here is 5 standard errors of a normal estimate: 6e-7 false failures
// each.

const std::vector<effects::NoiseAveraging> averages = {
    {.length = 1.2},
    {.length = 1.43},
    {.length = 3.0},
    {.length = 4.7},
    {.length = 0.9, .stages = 2},
    {.length = 2.5, .stages = 2},
    {.length = 2.0, .stages = 2, .of_samples = 1},
    {.length = 3.4, .stages = 1, .of_samples = 1}};

/// Autocovariance at every thousandth lag of white noise of unit density at rest, averaged once or
/// twice over `length` thousand samples.
std::vector<double> of_fine_noise(double length, int stages) {
  constexpr std::size_t fine = 1000;
  const auto box = static_cast<std::size_t>(std::lround(length * fine));
  std::vector<double> window(box, 1.0);
  if (stages == 2)
    for (std::size_t i = 1; i < 2 * box; ++i) {
      window.resize(2 * box - 1);
      window[i - 1] = static_cast<double>(std::min(i, 2 * box - i));
    }
  std::vector<double> covariance;
  double density = 0.0;
  for (std::size_t lag = 0; lag < window.size(); lag += fine) {
    double sum = 0.0;
    for (std::size_t i = lag; i < window.size(); ++i) sum += window[i] * window[i - lag];
    covariance.push_back(sum);
    density += lag == 0 ? sum : 2.0 * sum;
  }
  for (double& value : covariance) value /= density;
  return covariance;
}

TEST(NoiseAveraging, ItsAutocovarianceIsThatOfFasterNoiseAveraged) {
  for (const auto& average : averages) {
    if (average.of_samples > 0.5) continue;
    const auto stated = average.autocovariance();
    const auto fine = of_fine_noise(average.length, static_cast<int>(average.stages));
    ASSERT_EQ(stated.size(), fine.size()) << average.length;
    for (std::size_t lag = 0; lag < fine.size(); ++lag)
      EXPECT_NEAR(stated[lag], fine[lag], 1e-6) << average.length << ", lag " << lag;
  }
}

/// Taps 1, 2, 1 and 1, 2, 3, 2, 1, whose squares and products add up to so many parts of the square
/// of their sum; an average of a sample and a half has taps 1, 1/2.
TEST(NoiseAveraging, OfItsOwnSamplesHasTheAutocovarianceOfItsTaps) {
  const auto expect = [](const effects::NoiseAveraging& average, const std::vector<double>& parts) {
    const auto stated = average.autocovariance();
    ASSERT_EQ(stated.size(), parts.size());
    for (std::size_t lag = 0; lag < parts.size(); ++lag)
      EXPECT_NEAR(stated[lag], parts[lag], 1e-14) << lag;
  };
  expect({.length = 2.0, .stages = 2, .of_samples = 1}, {6.0 / 16, 4.0 / 16, 1.0 / 16});
  expect({.length = 3.0, .stages = 2, .of_samples = 1},
         {19.0 / 81, 16.0 / 81, 10.0 / 81, 4.0 / 81, 1.0 / 81});
  expect({.length = 1.5, .stages = 1, .of_samples = 1}, {1.25 / 2.25, 0.5 / 2.25});
  expect({.length = 0.5, .stages = 2, .of_samples = 1}, {1.0});
}

TEST(NoiseAveraging, MayHaveWhiteNoiseAfterIt) {
  constexpr std::size_t n = 100000;
  auto series = silent(even_times(n, 100.0));
  effects::NoiseAveraging{.length = 3.0, .after_dps = 0.02}.apply(series, {1, 0});
  const double error = 0.02 * 0.02 / std::sqrt(static_cast<double>(n));
  EXPECT_NEAR(autocovariance(series.gyro_dps, 0), 0.02 * 0.02, 5.0 * std::sqrt(2.0) * error);
  EXPECT_NEAR(autocovariance(series.gyro_dps, 1), 0.0, 5.0 * error);
}

/// What it makes of an impulse of white noise at each sample is a root of the covariance.
TEST(NoiseAveraging, HasItsAutocovarianceFromTheFirstSampleAndExactZerosBeyond) {
  constexpr std::size_t n = 60;
  for (const auto& average : averages) {
    std::vector<std::vector<double>> responses;
    for (std::size_t at = 0; at < n; ++at) {
      auto series = silent(even_times(n, 100.0));
      series.gyro_dps[at] = 1.0;
      average.apply(series, {1, 0});
      responses.push_back(series.gyro_dps);
    }
    auto expected = average.autocovariance();
    expected.resize(n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double covariance = 0.0;
        for (const auto& response : responses) covariance += response[i] * response[j];
        // The first samples of an average of the output's own average the last.
        if (average.of_samples > 0.5 && i - j >= n - 5) continue;
        EXPECT_NEAR(covariance, expected[i - j], 1e-12) << average.length << ": " << i << ", " << j;
      }
  }
}

/// A sample is between two of the noise, which come a tenth further at each or a tenth less; on
/// average over its ten places it has the autocovariance that is stated, to the trapezoid rule's
/// error of a hundredth of a fluctuation.
TEST(NoiseAveraging, InStraightLinesIsBetweenTwoSamples) {
  constexpr std::size_t n = 60, whole = 40;
  for (const double slip : {0.1, -0.1}) {
    const effects::NoiseAveraging average{.slip = slip};
    std::vector<double> place(n, 0.0), shares(n, 0.0);
    std::array<double, 3> covariance{};
    for (std::size_t at = 0; at < n; ++at) {
      auto series = silent(even_times(n, 100.0));
      series.gyro_dps[at] = 1.0;
      average.apply(series, {1, 0});
      for (std::size_t i = 0; i < n; ++i) {
        shares[i] += series.gyro_dps[i];
        place[i] += series.gyro_dps[i] * static_cast<double>(at);
        for (std::size_t lag = 0; lag < 3 && i < whole; ++lag)
          covariance[lag] += series.gyro_dps[i] * series.gyro_dps[i + lag] / whole;
      }
    }
    for (std::size_t i = 1; i < whole; ++i) {
      EXPECT_NEAR(shares[i], shares[0], 1e-12);
      EXPECT_NEAR((place[i] - place[i - 1]) / shares[0], 1.0 + slip, 1e-9);
    }
    const auto stated = average.autocovariance();
    for (std::size_t lag = 0; lag < 3; ++lag)
      EXPECT_NEAR(covariance[lag], stated[lag], 0.005) << slip << ' ' << lag;
  }
}

TEST(NoiseAveraging, OfWhiteNoiseHasItsAutocovariance) {
  constexpr std::size_t n = 200000;
  for (const auto& average : averages) {
    auto series = noisy(n, 100.0);
    average.apply(series, {1, 0});
    const auto averaged = white_part(series);
    const auto stated = average.autocovariance();
    const auto c = [&](int lag) {
      const auto at = static_cast<std::size_t>(std::abs(lag));
      return at < stated.size() ? 0.04 * stated[at] : 0.0;
    };
    for (const int lag : {0, 1, 2, 3, 8}) {
      double variance = 0.0;
      for (int k = -20; k <= 20; ++k) variance += (c(k) * c(k) + c(k + lag) * c(k - lag)) / n;
      EXPECT_NEAR(autocovariance(averaged, lag), c(lag), 5.0 * std::sqrt(variance))
          << average.length << ", lag " << lag;
    }
  }
}

TEST(NoiseAveraging, OverASampleOrLessLeavesTheNoiseWhite) {
  const auto before = noisy(1000, 100.0);
  for (const auto& average :
       {effects::NoiseAveraging{.length = 1.0}, {.length = 0.5, .stages = 2}, {.length = 0.1}}) {
    auto after = before;
    average.apply(after, {1, 0});
    EXPECT_EQ(after.gyro_dps, before.gyro_dps);
  }
}

TEST(NoiseAveraging, LeavesRateDriftAndRandomErrorAlone) {
  auto series = noisy(1000, 100.0);
  for (std::size_t i = 0; i < series.size(); ++i)
    series.gyro_dps[i] =
        series.rate_ref_dps[i] + series.thermal_bias_dps[i] + series.random_error_dps[i];
  const auto before = series.gyro_dps;
  effects::NoiseAveraging{.length = 2.5, .stages = 2}.apply(series, {1, 0});
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(series.gyro_dps[i], before[i], 1e-12);
}

}  // namespace
}  // namespace gyrostat::noise_averaging_test
