#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// A neighbour that switches on and off and pulls the gyro with it.
struct SquareWave {
  double amplitude_dps = 0.05;
  double period_s = 1.0;

  static constexpr std::string_view title = "the rate jumps up and down, evenly";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = SquareWave;
    return std::array{
        Field{"amplitude_dps", &P::amplitude_dps, "dps", ranges::any, "half of the jump"},
        Field{"period_s", &P::period_s, "s", ranges::positive, "from one jump up to the next"},
    };
  }

  static constexpr SquareWave absent() { return {.amplitude_dps = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    if (amplitude_dps == 0.0) return;
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double periods = (series.t_s[i] - series.t_s.front()) / period_s;
      series.gyro_dps[i] += periods - std::floor(periods) < 0.5 ? amplitude_dps : -amplitude_dps;
    }
  }
};

}  // namespace gyrostat::effects
