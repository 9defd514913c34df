#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/generators/random_error.hpp>
#include <gyrostat/generators/scenario.hpp>
#include <gyrostat/tests/generators/effect_series.hpp>

namespace gyrostat::noise_effects_test {
namespace {

// Every statistical tolerance here is 5 standard errors of a normal estimate: 6e-7 false failures
// each.

/// White noise of standard deviation 0.2 on a gyro that turns, drifts and wanders.
Series noisy(std::size_t samples, double rate_hz) {
  auto series = silent(even_times(samples, rate_hz));
  for (std::size_t i = 0; i < samples; ++i) {
    series.rate_ref_dps[i] = i / 100 % 2 == 0 ? 20.0 : -20.0;
    series.thermal_bias_dps[i] = 1e-5 * static_cast<double>(i);
    series.random_error_dps[i] = i % 7 == 0 ? 0.1 : 0.0;
    series.gyro_dps[i] =
        series.rate_ref_dps[i] + series.thermal_bias_dps[i] + series.random_error_dps[i];
  }
  add_white_noise(0.2, NormalStream(1, 0, "white_noise"), series.gyro_dps);
  return series;
}

std::vector<double> white_part(const Series& series) {
  std::vector<double> white;
  for (std::size_t i = 0; i < series.size(); ++i)
    white.push_back(series.gyro_dps[i] - series.rate_ref_dps[i] - series.thermal_bias_dps[i] -
                    series.random_error_dps[i]);
  return white;
}

TEST(Quantization, EveryValueIsTheNearestMultipleOfTheLsb) {
  const auto before = noisy(10000, 100.0);
  auto after = before;
  effects::Quantization{.lsb_dps = 0.03}.apply(after, {1, 0});
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(std::remainder(after.gyro_dps[i], 0.03), 0.0, 1e-12);
    EXPECT_LE(std::abs(after.gyro_dps[i] - before.gyro_dps[i]), 0.015 + 1e-12);
  }
}

// The residual e is uniform: the variance of e^2 is lsb^4 / 180, that of a lag product (lsb^2 /
// 12)^2.
TEST(Quantization, LeavesAWhiteResidualOfTheVarianceLsbSquaredOverTwelve) {
  constexpr std::size_t n = 200000;
  constexpr double lsb = 0.04;
  std::vector<double> residual;
  const auto before = noisy(n, 100.0);
  auto after = before;
  effects::Quantization{.lsb_dps = lsb}.apply(after, {1, 0});
  for (std::size_t i = 0; i < n; ++i) residual.push_back(after.gyro_dps[i] - before.gyro_dps[i]);
  EXPECT_NEAR(mean_square(residual), lsb * lsb / 12.0, 5.0 * lsb * lsb / std::sqrt(180.0 * n));
  EXPECT_NEAR(autocovariance(residual, 1), 0.0, 5.0 * lsb * lsb / 12.0 / std::sqrt(n));
}

// Bartlett: a sample autocovariance c_h over n samples has variance sum (c_k^2 + c_{k+h} c_{k-h}) /
// n.
TEST(NoiseBandwidth, MakesOfWhiteNoiseAFirstOrderAutoregression) {
  constexpr std::size_t n = 200000;
  auto series = noisy(n, 100.0);
  effects::NoiseBandwidth{.cutoff_hz = 5.0}.apply(series, {1, 0});
  const auto filtered = white_part(series);
  const double pole = std::exp(-2.0 * std::acos(-1.0) * 5.0 / 100.0);
  const auto c = [&](int lag) {
    return 0.04 * (1.0 - pole) / (1.0 + pole) * std::pow(pole, std::abs(lag));
  };
  for (const int lag : {0, 1, 3, 10}) {
    double variance = 0.0;
    for (int k = -300; k <= 300; ++k) variance += (c(k) * c(k) + c(k + lag) * c(k - lag)) / n;
    EXPECT_NEAR(autocovariance(filtered, lag), c(lag), 5.0 * std::sqrt(variance)) << "lag " << lag;
  }
}

// The density at f relative to rest is (1 + (2 sin(pi f / rate) sqrt(a) / (1 - a))^2)^-poles, a
// exact pole; the noise left over is its mean over all frequencies. 4 standard errors.
TEST(NoiseBandwidth, PolesFollowOneAnother) {
  constexpr std::size_t n = 200000;
  const double pi = std::acos(-1.0), pole = std::exp(-2.0 * pi * 5.0 / 100.0);
  for (const int poles : {2, 4}) {
    auto series = noisy(n, 100.0);
    effects::NoiseBandwidth{.cutoff_hz = 5.0, .poles = 1.0 * poles}.apply(series, {1, 0});
    double power = 0.0, power_of_power = 0.0;
    constexpr int steps = 20000;
    for (int k = 0; k < steps; ++k) {
      const double x =
          2.0 * std::sin(0.5 * pi * (k + 0.5) / steps) * std::sqrt(pole) / (1.0 - pole);
      const double density = std::pow(1.0 + x * x, -poles);
      power += 0.04 * density / steps;
      power_of_power += 0.04 * 0.04 * density * density / steps;
    }
    EXPECT_NEAR(autocovariance(white_part(series), 0), power,
                4.0 * std::sqrt(2.0 * power_of_power / n))
        << poles;
  }
}

// The spectrum of what a unit impulse leaves, against the folded filter's, of 2000 folds.
TEST(SampledLowPass, HasTheFoldedDensityOfItsFilter) {
  for (const std::size_t poles : {2, 3, 4})
    for (const bool flat : {false, true})
      for (const double cutoff : {0.08, 0.3, 0.45, 0.9, 180.0}) {
        SampledLowPass filter(LowPassSystem(cutoff, poles, flat));
        std::vector<double> response;
        for (int i = 0; i < 400; ++i) response.push_back(filter(i == 0 ? 1.0 : 0.0));
        const auto folded = [&](double at) {
          double sum = 0.0;
          for (int fold = -2000; fold <= 2000; ++fold) {
            const double square = std::pow((at + fold) / cutoff, 2.0);
            const double n = static_cast<double>(poles);
            sum += flat ? 1.0 / (1.0 + std::pow(square, n)) : std::pow(1.0 + square, -n);
          }
          return sum;
        };
        for (const double at : {0.01, 0.1, 0.3, 0.5}) {
          std::complex<double> sum = 0.0;
          for (std::size_t i = 0; i < response.size(); ++i)
            sum += response[i] *
                   std::polar(1.0, -2.0 * std::numbers::pi * at * static_cast<double>(i));
          const double gain = folded(at) / folded(0.0);
          EXPECT_NEAR(std::norm(sum), gain, 1e-6) << poles << flat << ' ' << cutoff << ' ' << at;
          EXPECT_NEAR(FoldedGain(cutoff, poles, flat)(at), gain, 2e-3 * gain);
        }
      }
}

// What a unit impulse leaves, against the gain that the diagnosis fits.
TEST(NoiseBandwidth, RingsAsItsDampingSays) {
  constexpr double interval_s = 0.01;
  for (const double continuous : {0.0, 1.0})
    for (const double damping_ratio : {0.15, 0.9})
      for (const double cutoff_hz : {4.0, 20.0}) {
        const effects::NoiseBandwidth filter{.cutoff_hz = cutoff_hz,
                                             .poles = 2.0,
                                             .continuous = continuous,
                                             .damping_ratio = damping_ratio};
        Series series;
        for (int i = 0; i < 4000; ++i) {
          series.t_s.push_back(interval_s * i);
          series.gyro_dps.push_back(i == 1 ? 1.0 : 0.0);
        }
        series.rate_ref_dps.assign(4000, 0.0);
        series.thermal_bias_dps.assign(4000, 0.0);
        series.random_error_dps.assign(4000, 0.0);
        filter.apply(series, {});
        for (const double hz : {0.5, 4.0, 20.0, 45.0}) {
          const double angle = 2.0 * std::numbers::pi * hz * interval_s;
          std::complex<double> sum = 0.0;
          for (std::size_t i = 0; i < series.size(); ++i)
            sum += series.gyro_dps[i] * std::polar(1.0, -angle * static_cast<double>(i));
          double gain = 1.0;
          const double cosine = std::cos(angle);
          filter.multiply_gain({&angle, 1}, {&cosine, 1}, interval_s, {&gain, 1});
          EXPECT_NEAR(std::norm(sum), gain, 2e-3 * gain + 1e-6)
              << continuous << ' ' << damping_ratio << ' ' << cutoff_hz << ' ' << hz;
        }
      }
}

// Squares of one normal deviate a trial: relative standard error sqrt(2 / trials).
TEST(NoiseBandwidth, IsStationaryFromTheFirstSample) {
  constexpr std::uint32_t trials = 4000;
  const double pole = std::exp(-2.0 * std::acos(-1.0) * 5.0 / 100.0);
  const double variance = (1.0 - pole) / (1.0 + pole);
  const auto draw = [](std::uint32_t trial) {
    auto series = silent(even_times(4, 100.0));
    add_white_noise(1.0, NormalStream(1, trial, "white_noise"), series.gyro_dps);
    effects::NoiseBandwidth{.cutoff_hz = 5.0}.apply(series, {1, trial});
    return series.gyro_dps;
  };
  for (const std::size_t i : {0, 1, 3})
    EXPECT_NEAR(mean_product(draw, trials, i, i) / variance, 1.0, 5.0 * std::sqrt(2.0 / trials))
        << i;
}

TEST(NoiseBandwidth, HasUnitGainAtRestAndLeavesRateAndDriftAlone) {
  auto series = silent(even_times(2000, 100.0));
  for (std::size_t i = 0; i < series.size(); ++i) {
    series.rate_ref_dps[i] = i % 2 == 0 ? 50.0 : -50.0;
    series.gyro_dps[i] = series.rate_ref_dps[i] + 0.25;
  }
  effects::NoiseBandwidth{.cutoff_hz = 2.0}.apply(series, {1, 0});
  for (std::size_t i = 1500; i < series.size(); ++i)
    EXPECT_NEAR(series.gyro_dps[i] - series.rate_ref_dps[i], 0.25, 1e-12);
}

TEST(NoiseBandwidth, DoesNotFilterSlowErrorsOrOutliers) {
  const auto gyro = [](const std::vector<Effect>& effects) {
    Scenario scenario;
    scenario.sampling = {.duration_s = 20.0, .rate_hz = 100.0};
    scenario.effects = effects;
    Series series;
    synthesise(scenario, {1, 0}, series);
    return series.gyro_dps;
  };
  const effects::NoiseBandwidth filter{.cutoff_hz = 1.0};
  const effects::Vibration vibration{};
  const effects::Outliers outliers{.probability = 0.1};
  const auto none = gyro({}), other = gyro({vibration, outliers}), filtered = gyro({filter}),
             both = gyro({vibration, outliers, filter});
  for (std::size_t i = 0; i < none.size(); ++i)
    EXPECT_NEAR(both[i] - filtered[i], other[i] - none[i], 1e-12);
}

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

TEST(AngleQuantization, NeverTakesTheAngleFartherThanAStep) {
  const std::vector<double> t_s = {0.0, 0.3, 5.0, 5.1, 9.0, 40.0};
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    const auto rate = added(effects::AngleQuantization{.coefficient_deg = 0.1}, t_s, trial);
    double angle_deg = 0.0;
    for (std::size_t i = 1; i < t_s.size(); ++i) {
      angle_deg += rate[i] * (t_s[i] - t_s[i - 1]);
      EXPECT_LE(std::abs(angle_deg), std::sqrt(12.0) * 0.1 + 1e-12);
    }
  }
}

// Of white e with E e^4 = 9/5 Q^4 the mean of d_i d_{i + lag}, d_i = e_i - e_{i-1}, is a sum of
// means of e^2 and of products at other lags, which are uncorrelated: n times its variance is 7.2,
// 5.8 and 6 Q^4 at lags 0, 1 and above.
TEST(AngleQuantization, IsCorrelatedWithItsNeighboursAlone) {
  constexpr std::size_t n = 200000;
  const auto rate =
      added(effects::AngleQuantization{.coefficient_deg = 0.003}, even_times(n, 100.0));
  constexpr double unit = 0.3 * 0.3;
  constexpr std::array expected = {2.0, -1.0, 0.0, 0.0};
  constexpr std::array variance = {7.2, 5.8, 6.0, 6.0};
  for (std::size_t lag = 0; lag < expected.size(); ++lag)
    EXPECT_NEAR(autocovariance(rate, lag) / unit, expected[lag], 5.0 * std::sqrt(variance[lag] / n))
        << "lag " << lag;
}

/// Rates are whole numbers of steps an interval, and their errors those of an angle rounded where
/// noise turns it by a step and more (within a part of exp(-2 pi^2), Widrow and Kollar,
/// "Quantization Noise", 2008, 4.3).
TEST(AngleQuantization, OnTheGridRoundsTheAngle) {
  constexpr std::size_t n = 200000;
  auto series = noisy(n, 100.0);
  const NormalStream noise(3, 0, "rate");
  for (std::size_t i = 0; i < n; ++i) series.gyro_dps[i] = 0.7 + 1.5 * noise.normal(i);
  const auto before = series.gyro_dps;
  const double coefficient_deg = 0.01 / std::sqrt(12.0);
  effects::AngleQuantization{coefficient_deg, 1.0}.apply(series, {1, 0});
  std::vector<double> error;
  double angle_deg = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_NEAR(series.gyro_dps[i], std::round(series.gyro_dps[i]), 1e-9) << i;
    error.push_back(series.gyro_dps[i] - before[i]);
    angle_deg += error[i] * 0.01;
    ASSERT_LE(std::abs(angle_deg), 0.01 + 1e-9) << i;
  }
  const double unit = std::pow(coefficient_deg / 0.01, 2);
  EXPECT_NEAR(autocovariance(error, 0) / unit, 2.0, 5.0 * std::sqrt(7.2 / n));
  EXPECT_NEAR(autocovariance(error, 1) / unit, -1.0, 5.0 * std::sqrt(5.8 / n));
  EXPECT_NEAR(autocovariance(error, 2) / unit, 0.0, 5.0 * std::sqrt(6.0 / n));
}

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

}  // namespace
}  // namespace gyrostat::noise_effects_test
