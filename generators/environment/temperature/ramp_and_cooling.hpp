#pragma once

#include <cmath>

#include <gyrostat/core/fields.hpp>

namespace gyrostat::temperature {

/// The experiment of [B]: a linear ramp up, then free cooling towards the room (Newton's law).
struct RampAndCooling {
  double start_C = 23.0;
  double peak_C = 57.0;
  double room_C = 23.0;
  double delay_s = 0.0;
  double ramp_s = 1200.0;
  double cooling_time_constant_s = 800.0;

  static constexpr std::string_view title = "linear ramp to a peak, then free cooling";

  static constexpr auto fields() {
    using P = RampAndCooling;
    return std::array{
        Field{"start_C", &P::start_C, "°C", ranges::temperature_C, "temperature at the start"},
        Field{"peak_C", &P::peak_C, "°C", ranges::temperature_C,
              "temperature at the end of the ramp"},
        Field{"room_C", &P::room_C, "°C", ranges::temperature_C,
              "temperature that cooling tends to"},
        Field{"delay_s", &P::delay_s, "s", ranges::non_negative, "time before the ramp"},
        Field{"ramp_s", &P::ramp_s, "s", ranges::positive, "duration of the ramp"},
        Field{"cooling_time_constant_s", &P::cooling_time_constant_s, "s", ranges::positive,
              "time constant of the cooling"},
    };
  }

  double operator()(double t_s) const {
    if (t_s <= delay_s) return start_C;
    const double after = t_s - delay_s - ramp_s;
    if (after <= 0.0) return peak_C + (peak_C - start_C) * after / ramp_s;
    return room_C + (peak_C - room_C) * std::exp(-after / cooling_time_constant_s);
  }
};

}  // namespace gyrostat::temperature
