#pragma once

#include <cmath>
#include <numbers>

#include <gyrostat/core/fields.hpp>

namespace gyrostat::acceleration {

/// A shaker table: at rest with its z axis up, and shaken along z by a sine for the first part of
/// each cycle.
struct Shaking {
  double amplitude_mps2 = 5.0;
  double frequency_hz = 4.3;
  double period_s = 120.0;
  double shaken = 0.5;

  static constexpr std::string_view title = "z axis up, shaken along it now and then";

  static constexpr auto fields() {
    using P = Shaking;
    return std::array{
        Field{"amplitude_mps2", &P::amplitude_mps2, "m/s²", ranges::any,
              "largest acceleration of the shaking"},
        Field{"frequency_hz", &P::frequency_hz, "Hz", ranges::positive, "its frequency"},
        Field{"period_s", &P::period_s, "s", ranges::positive, "duration of one cycle"},
        Field{"shaken", &P::shaken, "1", ranges::fraction, "share of a cycle that is shaken"},
    };
  }

  std::array<double, 3> operator()(double t_s) const {
    const double phase = t_s / period_s - std::floor(t_s / period_s);
    const double shake =
        phase < shaken ? amplitude_mps2 * std::sin(2.0 * std::numbers::pi * frequency_hz * t_s)
                       : 0.0;
    return {0.0, 0.0, 9.80665 + shake};
  }
};

}  // namespace gyrostat::acceleration
