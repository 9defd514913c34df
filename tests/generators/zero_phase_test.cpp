// Filters that go forward and back, and means of whole samples, as recordings are filtered
// afterwards.

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/generators/effects/noise_bandwidth.hpp>
#include <gyrostat/generators/effects/sensor_bandwidth.hpp>
#include <gyrostat/tests/generators/effect_series.hpp>
#include <gyrostat/tests/generators/noisy_series.hpp>

namespace gyrostat::zero_phase_test {
namespace {

using Filter = effects::SensorBandwidth;

const std::vector<double> rates = {0, 1, 4, 9, 7, 3, -2, -6, -5, 0, 6, 8, 5, 1, 0, 2};

/// scipy 1.10, filtfilt() of butter(2, 0.3), butter(4, 0.3) and of the recursion of one pole.
TEST(ZeroPhase, IsWhatScipyMakesOfIt) {
  struct Case {
    double poles, flat, cutoff_hz;
    std::vector<double> filtered;
  };
  for (const auto& [poles, flat, cutoff_hz, filtered] :
       {Case{2,
             1,
             15,
             {4.832751133e-03, 2.683527216e+00, 5.115824676e+00, 6.358913275e+00, 5.385397479e+00,
              2.303866856e+00, -1.343848512e+00, -3.468606042e+00, -2.782068204e+00,
              2.365173058e-01, 3.583384819e+00, 5.228845738e+00, 4.676178532e+00, 3.128734406e+00,
              2.114387230e+00, 2.003916331e+00}},
        Case{4,
             1,
             15,
             {0.009883658, 3.569798164, 6.200834113, 6.969273871, 5.353061492, 1.864680985,
              -1.841985817, -3.779938165, -2.906103983, 0.126607581, 3.42385976, 5.217450904,
              5.046683334, 3.793333313, 2.637713097, 1.978292381}},
        Case{1,
             0,
             10,
             {-0.009549753, 1.465495514, 3.130436966, 4.440645241, 3.890891283, 2.072794523,
              -0.123550313, -1.554408423, -1.171713328, 0.772709029, 3.032353536, 4.081363944,
              3.531789585, 2.383267333, 1.799040938, 1.94872282}}}) {
    const auto z = sensed(
        Filter{.cutoff_hz = cutoff_hz, .poles = poles, .maximally_flat = flat, .zero_phase = 1.0},
        rates);
    for (std::size_t i = 0; i < z.size(); ++i)
      EXPECT_NEAR(z[i], filtered[i], 2e-9) << poles << ' ' << flat << ' ' << i;
  }
}

/// The mean of so many samples, from the rate at rest before them.
TEST(SensorBandwidth, OfWholeSamplesIsTheirMean) {
  for (const int length : {1, 2, 5, 8})
    for (const bool is_centred : {false, true}) {
      if (is_centred && length % 2 == 0) continue;
      const auto z = sensed(Filter{.cutoff_hz = 100.0 * Filter::half_power_of_mean / length,
                                   .averages = 2.0,
                                   .before_dps = is_centred ? 0.0 : 3.0,
                                   .zero_phase = is_centred ? 1.0 : 0.0},
                            rates);
      const int n = static_cast<int>(rates.size()), ahead = is_centred ? (length - 1) / 2 : 0;
      for (int i = 0; i < n; ++i) {
        double sum = 0.0;
        for (int k = i + ahead - length + 1; k <= i + ahead; ++k)
          sum += k < 0 ? rates[0] + (is_centred ? 0.0 : 3.0) : rates[std::min(k, n - 1)];
        EXPECT_NEAR(z[i], sum / length, 1e-12) << length << is_centred << i;
      }
    }
}

/// The density of noise is that of one way twice: of Butterworth's poles it is (1 + x^2n)^-2 at
/// x = tan(pi f / rate) / tan(pi cutoff / rate). 4 standard errors: 6e-5 false failures each.
TEST(NoiseBandwidth, ForwardAndBackHasTheSquareOfItsDensity) {
  constexpr std::size_t n = 200000;
  constexpr double pi = std::numbers::pi;
  for (const int poles : {1, 2, 4}) {
    const effects::NoiseBandwidth filter{
        .cutoff_hz = 8.0, .poles = 1.0 * poles, .maximally_flat = 1.0, .zero_phase = 1.0};
    auto series = noisy(n, 100.0);
    filter.apply(series, {1, 0});
    double power = 0.0, power_of_power = 0.0;
    constexpr int steps = 20000;
    for (int k = 0; k < steps; ++k) {
      const double angle = pi * (k + 0.5) / steps;
      const double x = std::tan(0.5 * angle) / std::tan(0.08 * pi);
      const double density = std::pow(1.0 + std::pow(x, 2 * poles), -2);
      power += 0.04 * density / steps;
      power_of_power += 0.04 * 0.04 * density * density / steps;
      const double cosine = std::cos(angle);
      double gain = 1.0;
      filter.multiply_gain({&angle, 1}, {&cosine, 1}, 0.01, {&gain, 1});
      ASSERT_NEAR(gain, density, 1e-9) << poles << ' ' << k;
    }
    EXPECT_NEAR(autocovariance(white_part(series), 0), power,
                4.0 * std::sqrt(2.0 * power_of_power / n))
        << poles;
  }
}

}  // namespace
}  // namespace gyrostat::zero_phase_test
