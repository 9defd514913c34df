#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/fields.hpp"
#include "core/random.hpp"
#include "core/series.hpp"
#include "generators/stage.hpp"

namespace gyrostat::effects {

/// Exponentially correlated rate noise (IEEE Std 952 annex C): stationary, variance std^2,
/// autocorrelation exp(-lag / correlation time), exact between samples.
struct GaussMarkov {
  double std_dps = 0.005;
  double correlation_time_s = 100.0;

  static constexpr std::string_view title = "exponentially correlated noise";
  static constexpr Stage stage = Stage::electronics;

  static constexpr auto fields() {
    using P = GaussMarkov;
    return std::array{
        Field{"std_dps", &P::std_dps, "dps", ranges::non_negative,
              "standard deviation"},
        Field{"correlation_time_s", &P::correlation_time_s, "s", ranges::positive,
              "lag at which the autocorrelation is 1/e"},
    };
  }

  static constexpr GaussMarkov absent() { return {.std_dps = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    if (std_dps > 0.0) add_to(series, noise.stream("gauss_markov"));
  }

  void add_to(Series& series, const NormalStream& stream) const {
    std::array<double, 256> drawn;
    double state = 0.0, interval_s = -1.0, decay = 0.0, drive = 0.0;
    for (std::size_t i = 0; i < series.size(); ++i) {
      if (i % drawn.size() == 0)
        stream.fill(i, std::span(drawn).first(std::min(drawn.size(), series.size() - i)));
      const double a = drawn[i % drawn.size()];
      if (i == 0) {
        state = std_dps * a;
      } else {
        // Intervals that differ by rounding alone share their exponential.
        const double next_s = series.t_s[i] - series.t_s[i - 1];
        if (std::abs(next_s - interval_s) > 1e-6 * next_s) {
          interval_s = next_s;
          decay = std::exp(-interval_s / correlation_time_s);
          drive = std_dps * std::sqrt(-std::expm1(-2.0 * interval_s / correlation_time_s));
        }
        state = decay * state + drive * a;
      }
      series.gyro_dps[i] += state;
    }
  }
};

}  // namespace gyrostat::effects
