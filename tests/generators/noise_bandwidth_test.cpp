#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/generators/random_error.hpp>
#include <gyrostat/generators/scenario.hpp>
#include <gyrostat/tests/generators/noisy_series.hpp>

namespace gyrostat::noise_bandwidth_test {
namespace {

// Every statistical tolerance here is 5 standard errors of a normal estimate: 6e-7 false failures
// each.

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

std::vector<double> gyro(const std::vector<Effect>& effects) {
  Scenario scenario;
  scenario.sampling = {.duration_s = 20.0, .rate_hz = 100.0};
  scenario.effects = effects;
  Series series;
  synthesise(scenario, {1, 0}, series);
  return series.gyro_dps;
}

TEST(NoiseBandwidth, DoesNotFilterSlowErrorsOrOutliers) {
  const effects::NoiseBandwidth filter{.cutoff_hz = 1.0};
  const effects::Vibration vibration{};
  const effects::Outliers outliers{.probability = 0.1};
  const auto none = gyro({}), other = gyro({vibration, outliers}), filtered = gyro({filter}),
             both = gyro({vibration, outliers, filter});
  for (std::size_t i = 0; i < none.size(); ++i)
    EXPECT_NEAR(both[i] - filtered[i], other[i] - none[i], 1e-12);
}

TEST(NoiseBandwidth, FiltersOutliersThatAreBeforeIt) {
  const effects::NoiseBandwidth filter{.cutoff_hz = 1.0};
  const effects::Outliers before{.probability = 0.1, .before_filter = 1.0};
  const auto none = gyro({}), hit = gyro({before}), filtered = gyro({filter}),
             passed = gyro({before, filter}), behind = gyro({filter, before});
  const double pole = std::exp(-2.0 * std::numbers::pi * 0.01);
  for (std::size_t i = 1; i < none.size(); ++i) {
    EXPECT_NEAR(passed[i] - filtered[i],
                pole * (passed[i - 1] - filtered[i - 1]) + (1.0 - pole) * (hit[i] - none[i]),
                1e-12);
    // In a scenario's own order.
    EXPECT_NEAR(behind[i] - filtered[i], hit[i] - none[i], 1e-12);
  }
}

}  // namespace
}  // namespace gyrostat::noise_bandwidth_test
