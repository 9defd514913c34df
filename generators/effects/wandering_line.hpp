#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/numerics/sine_of_turns.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// A sine of constant amplitude whose frequency wanders about its mean as a Gauss-Markov process
/// (an oscillator with frequency noise), from a random phase. Its autocovariance at lag h is
///   amplitude^2 / 2 cos(2 pi frequency h) exp(-(2 pi wander T)^2 (h / T - 1 + exp(-h / T)))
/// with T the correlation time. Exact between samples, even or not: the phase turns by the integral
/// of the process, which is normal given its values at both ends.
struct WanderingLine {
  double amplitude_dps = 0.02;
  double frequency_hz = 20.0;
  double wander_hz = 0.5;
  double correlation_time_s = 1.0;

  static constexpr std::string_view title = "a sine whose frequency wanders";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = WanderingLine;
    return std::array{
        Field{"amplitude_dps", &P::amplitude_dps, "dps", ranges::non_negative, "amplitude"},
        Field{"frequency_hz", &P::frequency_hz, "Hz", ranges::non_negative, "mean frequency"},
        Field{"wander_hz", &P::wander_hz, "Hz", ranges::non_negative,
              "standard deviation of the frequency"},
        Field{"correlation_time_s", &P::correlation_time_s, "s", ranges::positive,
              "lag at which the frequency's autocorrelation is 1/e"},
    };
  }

  /// Of its phase at two times: the last factor of its autocovariance.
  double coherence(double lag_s) const {
    const double radians = 2.0 * std::numbers::pi * wander_hz * correlation_time_s;
    const double memories = lag_s / correlation_time_s;
    // Near lag 0 the sum of its terms would be lost.
    const double spread =
        memories < 1e-4 ? 0.5 * memories * memories : memories + std::expm1(-memories);
    return std::exp(-radians * radians * spread);
  }

  bool operator==(const WanderingLine&) const = default;
  static constexpr WanderingLine absent() { return {.amplitude_dps = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    Deviates at_sample(noise.stream("wandering_line/frequency"));
    Deviates between(noise.stream("wandering_line/between"));
    Decay decay(correlation_time_s);
    double turns = noise.stream("wandering_line/phase").uniform(0), state = 0.0;
    double a = 0.0, drive = 1.0, half = 1.0, spread = 0.0;  // half: tanh(interval / (2 T))
    std::array<double, 256> phases;
    const std::size_t n = samples_with(series, needs);
    for (std::size_t first = 0; first < n; first += phases.size()) {
      const std::size_t count = std::min(phases.size(), n - first);
      for (std::size_t k = 0, i = first; k < count; ++k, ++i) {
        const double before = state;
        if (const double next = decay(series.t_s, i); next != a || i == 1) {
          a = next;
          drive = std::sqrt((1.0 - a) * (1.0 + a));
          half = (1.0 - a) / (1.0 + a);
          const double memories = (series.t_s[i] - series.t_s[i - 1]) / correlation_time_s;
          spread = std::sqrt(std::max(0.0, 2.0 * memories - 4.0 * half));
        }
        state = a * state + drive * at_sample.next();
        if (i > 0) {
          const double interval_s = series.t_s[i] - series.t_s[i - 1];
          const double integral_s =
              correlation_time_s * (half * (before + state) + spread * between.next());
          turns = within_a_turn(turns + frequency_hz * interval_s + wander_hz * integral_s);
        }
        phases[k] = turns;
      }
      for (std::size_t k = 0; k < count; ++k)
        series.gyro_dps[first + k] += amplitude_dps * sine_of_turns(phases[k]);
    }
  }
};

}  // namespace gyrostat::effects
