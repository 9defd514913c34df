#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/diagnosis/starts/train_steps.hpp>
#include <gyrostat/generators/effects/noise_bandwidth.hpp>

namespace gyrostat::gap {

/// Noise through a low-pass filter of one, two or four poles, each a start of its own.
template <>
struct Diagnosed<effects::NoiseBandwidth> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::NoiseBandwidth::cutoff_hz};

  /// From the variance and the first autocorrelation of the steps from sample to sample.
  static std::vector<Start> starts(const Evidence& e) {
    const auto steps = train_steps(e);
    double square = 0.0, lagged = 0.0;
    for (std::size_t i = 1; i < steps.size(); ++i) {
      square += steps[i] * steps[i];
      lagged += steps[i] * steps[i - 1];
    }
    const double rate_hz = e.conditions().rate_hz();
    std::vector<Start> found;
    for (const int poles : {1, 2, 4}) {
      double low = 0.002, high = 0.99;
      for (int k = 0; k < 30; ++k) {
        const double pole = 0.5 * (low + high);
        const auto r = through_poles(pole, poles);
        ((2.0 * r[1] - r[0] - r[2]) / (2.0 * (r[0] - r[1])) < lagged / square ? low : high) = pole;
      }
      const auto r = through_poles(low, poles);
      found.push_back({effects::NoiseBandwidth{-std::log(low) * rate_hz / (2.0 * std::numbers::pi),
                                               1.0 * poles},
                       with_white(e, std::sqrt(square / static_cast<double>(steps.size()) /
                                               (2.0 * (r[0] - r[1]))))});
    }
    return found;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::NoiseBandwidth& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }

 private:
  /// Autocovariance at lags 0, 1 and 2 of unit white noise through equal poles.
  static std::array<double, 3> through_poles(double pole, int poles) {
    std::vector<double> response(static_cast<std::size_t>(8.0 * poles / (1.0 - pole)) + 8, 0.0);
    response[0] = 1.0;
    for (int k = 0; k < poles; ++k) {
      double state = 0.0;
      for (double& h : response) h = state = pole * state + (1.0 - pole) * h;
    }
    std::array<double, 3> covariance{};
    for (std::size_t lag = 0; lag < 3; ++lag)
      for (std::size_t i = lag; i < response.size(); ++i)
        covariance[lag] += response[i] * response[i - lag];
    return covariance;
  }
};

}  // namespace gyrostat::gap
