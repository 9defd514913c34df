#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/tests/generators/effect_series.hpp>

namespace gyrostat::slow_effects_test {
namespace {

// Every statistical tolerance here is 5 standard errors of an estimate that is normal by the number
// of independent trials: 6e-7 false failures each, unless a test says otherwise.

/// Uneven times, close together and far apart.
const std::vector<double> uneven = {0.0, 0.3, 5.0, 5.1, 9.0, 40.0};

constexpr std::uint32_t trials = 4000;

/// The covariance of every pair of samples over trials against `covariance(interval)`. The product
/// of two normals has variance c(0)^2 + c(interval)^2.
template <class Effect, class Covariance>
void expect_stationary_normal(const Effect& effect, const Covariance& covariance) {
  std::array<std::array<double, 6>, 6> sum{};
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    const auto v = added(effect, uneven, trial);
    for (std::size_t i = 0; i < v.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j) sum[i][j] += v[i] * v[j] / trials;
  }
  for (std::size_t i = 0; i < uneven.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const double expected = covariance(uneven[i] - uneven[j]);
      EXPECT_NEAR(sum[i][j], expected,
                  5.0 * std::hypot(covariance(0.0), expected) / std::sqrt(trials))
          << uneven[i] << " s and " << uneven[j] << " s";
    }
}

TEST(GaussMarkov, HasItsVarianceAndExponentialCorrelationAtUnevenTimes) {
  expect_stationary_normal(effects::GaussMarkov{.std_dps = 0.2, .correlation_time_s = 4.0},
                           [](double lag) { return 0.04 * std::exp(-lag / 4.0); });
}

TEST(GaussMarkov, OfSecondOrderIsSmoothAtUnevenTimes) {
  const effects::GaussMarkov effect{.std_dps = 0.2, .correlation_time_s = 4.0, .order = 2.0};
  const double T = effect.time_constant_s();
  expect_stationary_normal(effect,
                           [&](double lag) { return 0.04 * (1.0 + lag / T) * std::exp(-lag / T); });
}

TEST(GaussMarkov, OfSecondOrderForgetsNothingOverManyShortIntervals) {
  const effects::GaussMarkov effect{.std_dps = 1.0, .correlation_time_s = 2.0, .order = 2.0};
  const auto draw = [&](std::uint32_t trial) {
    return added(effect, even_times(201, 100.0), trial);
  };
  const double rho = std::exp(-1.0);
  EXPECT_NEAR(mean_product(draw, trials, 0, 200), rho, 5.0 * std::sqrt((1.0 + rho * rho) / trials));
  EXPECT_NEAR(mean_product(draw, trials, 200, 200), 1.0, 5.0 * std::sqrt(2.0 / trials));
}

TEST(GaussMarkov, ForgetsNothingOverManyShortIntervals) {
  const effects::GaussMarkov effect{.std_dps = 1.0, .correlation_time_s = 2.0};
  const auto draw = [&](std::uint32_t trial) {
    return added(effect, even_times(201, 100.0), trial);
  };
  const double rho = std::exp(-1.0);
  EXPECT_NEAR(mean_product(draw, trials, 0, 200), rho, 5.0 * std::sqrt((1.0 + rho * rho) / trials));
  EXPECT_NEAR(mean_product(draw, trials, 200, 200), 1.0, 5.0 * std::sqrt(2.0 / trials));
}

TEST(Vibration, HasItsVarianceCentreAndBandwidthAtUnevenTimes) {
  expect_stationary_normal(
      effects::Vibration{.std_dps = 0.3, .centre_hz = 0.7, .bandwidth_hz = 0.05}, [](double lag) {
        return 0.09 * std::exp(-std::numbers::pi * 0.05 * lag) *
               std::cos(2.0 * std::numbers::pi * 0.7 * lag);
      });
}

/// exp of minus half the variance of the phase over `lag`.
double coherence(const effects::WanderingLine& line, double lag) {
  const double T = line.correlation_time_s, turn = 2.0 * std::numbers::pi * line.wander_hz * T;
  return std::exp(-turn * turn * (lag / T - 1.0 + std::exp(-lag / T)));
}

// A product of two sines of amplitude A has at most the variance 3 A^4 / 8, its square the mean
// 3 A^4 / 8 and, with E sin^8 = 35 / 128, the variance 17 A^8 / 128.
TEST(WanderingLine, HasItsAutocovarianceAtUnevenTimes) {
  for (const double correlation_time_s : {0.5, 8.0}) {
    const effects::WanderingLine line{.amplitude_dps = 0.3,
                                      .frequency_hz = 0.7,
                                      .wander_hz = 0.15,
                                      .correlation_time_s = correlation_time_s};
    std::array<std::array<double, 6>, 6> sum{};
    double fourth = 0.0;
    for (std::uint32_t trial = 0; trial < trials; ++trial) {
      const auto v = added(line, uneven, trial);
      fourth += std::pow(v[3], 4) / trials;
      for (std::size_t i = 0; i < v.size(); ++i)
        for (std::size_t j = 0; j <= i; ++j) sum[i][j] += v[i] * v[j] / trials;
    }
    EXPECT_NEAR(fourth, 3.0 / 8.0 * 0.0081, 5.0 * 0.0081 * std::sqrt(17.0 / 128.0 / trials));
    for (std::size_t i = 0; i < uneven.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        const double lag = uneven[i] - uneven[j];
        EXPECT_NEAR(sum[i][j],
                    0.045 * std::cos(2.0 * std::numbers::pi * 0.7 * lag) * coherence(line, lag),
                    5.0 * 0.09 * std::sqrt(3.0 / 8.0 / trials))
            << uneven[i] << " s and " << uneven[j] << " s";
      }
  }
}

// Its amplitude over a period each, where that of a vibration comes and goes. A frequency that is
// five standard deviations off changes it by a tenth, and the ends of the period by another.
TEST(WanderingLine, KeepsItsAmplitude) {
  const auto v = added(
      effects::WanderingLine{
          .amplitude_dps = 0.5, .frequency_hz = 20.0, .wander_hz = 1.0, .correlation_time_s = 1.0},
      even_times(100000, 200.0));
  double least = 1.0, most = 0.0;
  for (std::size_t i = 0; i + 10 <= v.size(); i += 10) {  // a period
    double in_phase = 0.0, quadrature = 0.0;
    for (std::size_t k = 0; k < 10; ++k) {
      in_phase += v[i + k] * std::cos(0.2 * std::numbers::pi * static_cast<double>(k)) / 5.0;
      quadrature += v[i + k] * std::sin(0.2 * std::numbers::pi * static_cast<double>(k)) / 5.0;
    }
    least = std::min(least, std::hypot(in_phase, quadrature));
    most = std::max(most, std::hypot(in_phase, quadrature));
  }
  EXPECT_GT(least, 0.8 * 0.5);
  EXPECT_LT(most, 1.2 * 0.5);
}

// Of a sine of power L in normal noise of power N the excess kurtosis is -3/2 (L / (L + N))^2:
// where an ADIS16405 has one, 30 % of the variance between 17 and 23 Hz, about -0.9; of vibration
// it would be 0. The error is the spread of independent trials, 5 of it with 39 degrees of freedom
// are passed at 1e-5; beside it 0.02 for what the filter takes of the line.
TEST(WanderingLine, InItsBandIsFlatterThanNormalNoise) {
  constexpr std::size_t n = 10000;
  constexpr int reach = 100;
  constexpr std::uint32_t few = 40;
  std::vector<double> filter;
  double gain = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    const double x = std::numbers::pi * k / 100.0;  // an ideal band, through a Hann window
    const double ideal = k == 0 ? 0.12 : (std::sin(46.0 * x) - std::sin(34.0 * x)) / (100.0 * x);
    filter.push_back(ideal * std::pow(std::cos(0.5 * std::numbers::pi * k / (reach + 1)), 2));
    gain += filter.back() * filter.back();
  }
  const double line = 0.3, noise = 0.7 * gain;
  double sum = 0.0, square = 0.0;
  for (std::uint32_t trial = 0; trial < few; ++trial) {
    auto series = silent(even_times(n, 100.0));
    NormalStream(1, trial, "white").fill(0, series.gyro_dps);
    for (double& value : series.gyro_dps) value *= std::sqrt(0.7);
    effects::WanderingLine{.amplitude_dps = std::sqrt(2.0 * line), .frequency_hz = 20.0}.apply(
        series, {1, trial});
    double second = 0.0, fourth = 0.0;
    for (std::size_t i = 0; i + filter.size() <= n; ++i) {
      double y = 0.0;
      for (std::size_t k = 0; k < filter.size(); ++k) y += filter[k] * series.gyro_dps[i + k];
      second += y * y;
      fourth += y * y * y * y;
    }
    const auto count = static_cast<double>(n + 1 - filter.size());
    const double excess = fourth * count / (second * second) - 3.0;
    sum += excess / few;
    square += excess * excess / few;
  }
  const double share = line / (line + noise), error = std::sqrt((square - sum * sum) / (few - 1));
  EXPECT_NEAR(sum, -1.5 * share * share, 5.0 * error + 0.02);
}

TEST(WanderingLine, ThatDoesNotWanderIsASineOfRandomPhase) {
  const auto v =
      added(effects::WanderingLine{.amplitude_dps = 0.5, .frequency_hz = 2.0, .wander_hz = 0.0},
            even_times(5000, 100.0));
  const double turn = 2.0 * std::numbers::pi * 2.0 / 100.0;
  for (std::size_t i = 1; i + 1 < v.size(); ++i)
    EXPECT_NEAR(v[i + 1] + v[i - 1], 2.0 * std::cos(turn) * v[i], 1e-10);
}

// Of normal x and y, correlated by rho and both there with probability p, E x^2 y^2 =
// p (1 + 2 rho^2) std^4.
TEST(VibrationBursts, HaveTheAutocovarianceOfVibrationThatIsSwitched) {
  const effects::VibrationBursts bursts{.std_dps = 0.3,
                                        .centre_hz = 0.7,
                                        .bandwidth_hz = 0.05,
                                        .mean_duration_s = 4.0,
                                        .mean_interval_s = 12.0};
  std::array<std::array<double, 6>, 6> sum{};
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    const auto v = added(bursts, uneven, trial);
    for (std::size_t i = 0; i < v.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j) sum[i][j] += v[i] * v[j] / trials;
  }
  for (std::size_t i = 0; i < uneven.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const double lag = uneven[i] - uneven[j];
      const double rho =
          std::exp(-std::numbers::pi * 0.05 * lag) * std::cos(2.0 * std::numbers::pi * 0.7 * lag);
      const double both = 0.0625 + 0.1875 * std::exp(-lag / 3.0);
      const double square = both * (1.0 + 2.0 * rho * rho) - both * rho * both * rho;
      EXPECT_NEAR(sum[i][j], 0.09 * rho * both, 5.0 * 0.09 * std::sqrt(square / trials))
          << uneven[i] << " s and " << uneven[j] << " s";
    }
}

// Whether it is there follows a chain of two states, share s = 0.3 and rate of change 1 / 2.1 s: it
// is not at one sample and is at the next with probability s (1 - s) (1 - exp(-0.1 / 2.1)). The
// number of begins varies by less than that of a Poisson process, the share by 2 s (1 - s) 2.1 s
// over the duration.
TEST(VibrationBursts, ComeAndGoInTheirMeanTimes) {
  const effects::VibrationBursts bursts{
      .std_dps = 1.0, .mean_duration_s = 3.0, .mean_interval_s = 7.0};
  const auto v = added(bursts, even_times(400000, 10.0));
  double begun = 0.0, with = 0.0;
  for (std::size_t i = 1; i < v.size(); ++i) {
    begun += v[i] != 0.0 && v[i - 1] == 0.0;
    with += v[i] != 0.0;
  }
  const double expected = 400000.0 * 0.21 * (1.0 - std::exp(-0.1 / 2.1));
  EXPECT_NEAR(begun, expected, 5.0 * std::sqrt(expected));
  EXPECT_NEAR(with / 400000.0, 0.3, 5.0 * std::sqrt(2.0 * 0.21 * 2.1 / 40000.0));
}

TEST(StartUp, SettlesExponentiallyFromTheFirstSample) {
  const auto v = added(effects::StartUp{.amplitude_dps = -0.2, .settling_time_s = 4.0},
                       {1000.0, 1001.0, 1004.0, 1400.0});
  EXPECT_EQ(v[0], -0.2);
  EXPECT_DOUBLE_EQ(v[1], -0.2 * std::exp(-0.25));
  EXPECT_DOUBLE_EQ(v[2], -0.2 * std::exp(-1.0));
  EXPECT_NEAR(v[3], 0.0, 1e-40);
}

// The variance at one tau is a mean over independent trials and its error their own spread: 5 of
// them with 39 degrees of freedom fail falsely at 1e-5. Beside it 3 % for the ends of the sum.
TEST(BiasInstability, HasItsAllanFloorOverTwoDecades) {
  constexpr double B = 0.02, floor = 2.0 * std::numbers::ln2 / std::numbers::pi * B * B;
  constexpr std::uint32_t few = 40;
  const std::vector<std::size_t> clusters = {30, 100, 300, 1000, 3000};
  std::vector<double> sum(clusters.size()), square(clusters.size());
  for (std::uint32_t trial = 0; trial < few; ++trial) {
    const auto v =
        added(effects::BiasInstability{.coefficient_dps = B}, even_times(60000, 10.0), trial);
    const auto points = overlapping_allan_deviation(v, 10.0, clusters);
    for (std::size_t k = 0; k < clusters.size(); ++k) {
      const double variance = points[k].deviation * points[k].deviation / floor;
      sum[k] += variance / few;
      square[k] += variance * variance / few;
    }
  }
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    const double error = std::sqrt((square[k] - sum[k] * sum[k]) / (few - 1));
    EXPECT_NEAR(sum[k], 1.0, 5.0 * error + 0.03) << "tau " << clusters[k] << " samples";
  }
}

TEST(RateRamp, GrowsEvenlyFromTheFirstSample) {
  const auto v = added(effects::RateRamp{.slope_dps_per_s = 0.01}, {5.0, 6.0, 9.0});
  EXPECT_EQ(v[0], 0.0);
  EXPECT_DOUBLE_EQ(v[1], 0.01);
  EXPECT_DOUBLE_EQ(v[2], 0.04);
}

TEST(SinusoidalEffect, IsTheSineOfItsAmplitudeFrequencyAndPhase) {
  const auto v =
      added(effects::Sinusoidal{.amplitude_dps = 0.3, .frequency_hz = 0.25, .phase_deg = 90.0},
            {100.0, 101.0, 102.0, 106.0});
  EXPECT_NEAR(v[0], 0.3, 1e-15);
  EXPECT_NEAR(v[1], 0.0, 1e-15);
  EXPECT_NEAR(v[2], -0.3, 1e-15);
  EXPECT_NEAR(v[3], -0.3, 1e-14);
}

// Of N jumps, Poisson with mean m: E x^2 = m s^2 and E x^4 = 3 (m^2 + m) s^4.
TEST(BiasSteps, VarianceGrowsByThatOfAJumpAtEachExpectedJump) {
  const effects::BiasSteps steps{.steps_per_hour = 8.0, .std_dps = 0.5};
  const std::vector<double> t_s = {0.0, 900.0, 1800.0, 5400.0};
  std::array<double, 4> square{};
  double disjoint = 0.0;
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    const auto v = added(steps, t_s, trial);
    for (std::size_t i = 0; i < t_s.size(); ++i) square[i] += v[i] * v[i] / trials;
    disjoint += v[1] * (v[2] - v[1]) / trials;
  }
  EXPECT_EQ(square[0], 0.0);
  for (std::size_t i = 1; i < t_s.size(); ++i) {
    const double m = 8.0 * t_s[i] / 3600.0;
    EXPECT_NEAR(square[i], 0.25 * m, 5.0 * 0.25 * std::sqrt((2.0 * m * m + 3.0 * m) / trials))
        << t_s[i];
  }
  EXPECT_NEAR(disjoint, 0.0, 5.0 * 0.25 * 2.0 / std::sqrt(trials));
}

TEST(BiasSteps, BetweenJumpsIsConstant) {
  const auto v =
      added(effects::BiasSteps{.steps_per_hour = 60.0, .std_dps = 0.5}, even_times(36000, 10.0));
  double jumps = 0.0;
  for (std::size_t i = 1; i < v.size(); ++i) jumps += v[i] != v[i - 1];
  EXPECT_NEAR(jumps, 60.0, 5.0 * std::sqrt(60.0));
  EXPECT_GT(jumps, 0.0);
}

// A product is +-A^2, of variance A^4 (1 - rho^2).
TEST(Telegraph, HasTheVarianceAndCorrelationOfATwoLevelProcess) {
  const effects::Telegraph telegraph{.amplitude_dps = 0.4, .mean_dwell_s = 6.0};
  std::array<double, 6> mean{}, product{};
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    const auto v = added(telegraph, uneven, trial);
    for (std::size_t i = 0; i < v.size(); ++i) {
      ASSERT_EQ(std::abs(v[i]), 0.4);
      mean[i] += v[i] / trials;
      product[i] += v[i] * v[0] / trials;
    }
  }
  for (std::size_t i = 0; i < uneven.size(); ++i) {
    const double rho = std::exp(-2.0 * uneven[i] / 6.0);
    EXPECT_NEAR(mean[i], 0.0, 5.0 * 0.4 / std::sqrt(trials)) << uneven[i];
    EXPECT_NEAR(product[i], 0.16 * rho, 5.0 * 0.16 * std::sqrt((1.0 - rho * rho) / trials) + 1e-12);
  }
}

// Whether a level differs from the one an interval before is a coin of probability
// (1 - exp(-2 interval / dwell)) / 2, independent of the rest.
TEST(Telegraph, DwellsForItsMeanTime) {
  constexpr std::size_t n = 400000;
  const auto v =
      added(effects::Telegraph{.amplitude_dps = 1.0, .mean_dwell_s = 5.0}, even_times(n, 10.0));
  double changes = 0.0;
  for (std::size_t i = 1; i < n; ++i) changes += v[i] != v[i - 1];
  const double p = 0.5 * (1.0 - std::exp(-0.04));
  EXPECT_NEAR(changes, p * (n - 1), 5.0 * std::sqrt(n * p * (1.0 - p)));
}

}  // namespace
}  // namespace gyrostat::slow_effects_test
