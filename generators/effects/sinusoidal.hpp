#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// A line: a sine of fixed frequency (IEEE Std 952 annex C, sinusoidal noise).
struct Sinusoidal {
  double amplitude_dps = 0.01;
  double frequency_hz = 0.1;
  double phase_deg = 0.0;

  static constexpr std::string_view title = "a sine of fixed frequency";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = Sinusoidal;
    return std::array{
        Field{"amplitude_dps", &P::amplitude_dps, "dps", ranges::non_negative, "amplitude"},
        Field{"frequency_hz", &P::frequency_hz, "Hz", ranges::non_negative, "frequency"},
        Field{"phase_deg", &P::phase_deg, "deg", ranges::any, "phase at the first sample"},
    };
  }

  static constexpr Sinusoidal absent() { return {.amplitude_dps = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    if (amplitude_dps == 0.0) return;
    constexpr double rad = std::numbers::pi / 180.0;
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] += amplitude_dps * std::sin(2.0 * std::numbers::pi * frequency_hz *
                                                         (series.t_s[i] - series.t_s.front()) +
                                                     phase_deg * rad);
  }
};

}  // namespace gyrostat::effects
