#pragma once

#include <cmath>

#include <gyrostat/core/fields.hpp>

namespace gyrostat::temperature {

/// A sensor that warms itself up in a quiet room: first-order approach to a final temperature.
/// The defaults are the experiment of [A], 37.8 to 40.1 °C.
struct QuietRoom {
  double start_C = 37.8;
  double end_C = 40.1;
  double time_constant_s = 20.0;

  static constexpr std::string_view title = "first-order warm-up in a quiet room";

  static constexpr auto fields() {
    using P = QuietRoom;
    return std::array{
        Field{"start_C", &P::start_C, "°C", ranges::temperature_C, "temperature at the start"},
        Field{"end_C", &P::end_C, "°C", ranges::temperature_C, "temperature that is tended to"},
        Field{"time_constant_s", &P::time_constant_s, "s", ranges::positive,
              "time constant of the warm-up"},
    };
  }

  double operator()(double t_s) const {
    return end_C + (start_C - end_C) * std::exp(-t_s / time_constant_s);
  }
};

}  // namespace gyrostat::temperature
