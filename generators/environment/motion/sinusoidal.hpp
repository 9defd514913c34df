#pragma once

#include <cmath>
#include <numbers>

#include <gyrostat/core/fields.hpp>

namespace gyrostat::motion {

/// A table swinging to and fro.
struct Sinusoidal {
  double amplitude_dps = 10.0;
  double frequency_hz = 0.1;

  static constexpr std::string_view title = "sinusoidal rate";

  static constexpr auto fields() {
    using P = Sinusoidal;
    return std::array{
        Field{"amplitude_dps", &P::amplitude_dps, "dps", ranges::any, "largest rate"},
        Field{"frequency_hz", &P::frequency_hz, "Hz", ranges::positive, "frequency of the swing"},
    };
  }

  double operator()(double t_s) const {
    return amplitude_dps * std::sin(2.0 * std::numbers::pi * frequency_hz * t_s);
  }
};

}  // namespace gyrostat::motion
