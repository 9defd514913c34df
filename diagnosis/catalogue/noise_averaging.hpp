#pragma once

#include <cmath>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/diagnosis/starts/train_steps.hpp>
#include <gyrostat/generators/effects/noise_averaging.hpp>

namespace gyrostat::gap {

/// Noise that is averaged once or twice, each a start of its own.
template <>
struct Diagnosed<effects::NoiseAveraging> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::NoiseAveraging::length};

  /// The length whose steps from sample to sample are correlated as the recording's are.
  static std::vector<Start> starts(const Evidence& e) {
    const auto steps = train_steps(e);
    std::vector<double> seen(lags, 0.0);
    for (std::size_t lag = 0; lag < lags; ++lag)
      for (std::size_t i = lag; i < steps.size(); ++i) seen[lag] += steps[i] * steps[i - lag];
    std::vector<Start> found;
    for (const double stages : {1.0, 2.0}) {
      effects::NoiseAveraging effect{1.0, stages};
      effect.length = best_of(1.0 / stages, 0.25 * static_cast<double>(lags), [&](double length) {
        const auto expected = of_steps({length, stages});
        double cost = 0.0;
        for (std::size_t lag = 1; lag < lags; ++lag)
          cost += std::pow(expected[lag] / expected[0] - seen[lag] / seen[0], 2);
        return cost;
      });
      const double white_dps2 =
          seen[0] / static_cast<double>(steps.size()) / of_steps(effect).front();
      found.push_back({effect, with_white(e, std::sqrt(white_dps2))});
    }
    return found;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::NoiseAveraging& effect, const Conditions& /*c*/) {
    return effect.autocovariance().size() > 1;
  }

 private:
  static constexpr std::size_t lags = 24;

  /// Autocovariance of the steps from sample to sample of unit white noise that is averaged.
  static std::vector<double> of_steps(const effects::NoiseAveraging& effect) {
    auto c = effect.autocovariance();
    c.resize(std::max(c.size(), lags + 1), 0.0);
    std::vector<double> steps = {2.0 * (c[0] - c[1])};
    for (std::size_t lag = 1; lag < lags; ++lag)
      steps.push_back(2.0 * c[lag] - c[lag - 1] - c[lag + 1]);
    return steps;
  }
};

}  // namespace gyrostat::gap
