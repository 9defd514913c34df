#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Exponentially correlated rate noise (IEEE Std 952 annex C): stationary, variance std^2,
/// autocorrelation exp(-lag / correlation time), exact between samples.
struct GaussMarkov {
  double std_dps = 0.005;
  double correlation_time_s = 100.0;

  static constexpr std::string_view title = "exponentially correlated noise";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = GaussMarkov;
    return std::array{
        Field{"std_dps", &P::std_dps, "dps", ranges::non_negative, "standard deviation"},
        Field{"correlation_time_s", &P::correlation_time_s, "s", ranges::positive,
              "lag at which the autocorrelation is 1/e"},
    };
  }

  static constexpr GaussMarkov absent() { return {.std_dps = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    Deviates white(noise.stream("gauss_markov"));
    Decay decay(correlation_time_s);
    double state = 0.0;
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double a = decay(series.t_s, i);
      state = a * state + std::sqrt((1.0 - a) * (1.0 + a)) * white.next();
      series.gyro_dps[i] += std_dps * state;
    }
  }
};

}  // namespace gyrostat::effects
