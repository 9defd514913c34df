#pragma once

#include <cmath>
#include <numbers>

#include <gyrostat/core/fields.hpp>

namespace gyrostat::acceleration {

/// A slow sinusoidal tilt by the roll angle r about x and the pitch angle p about y, too slow for
/// any acceleration but gravity's: a = g (-sin p, sin r cos p, cos r cos p).
struct Tilting {
  double roll_amplitude_deg = 30.0;
  double roll_period_s = 300.0;
  double pitch_amplitude_deg = 20.0;
  double pitch_period_s = 420.0;

  static constexpr std::string_view title = "slow sinusoidal tilt about x and y";

  static constexpr auto fields() {
    using P = Tilting;
    constexpr Range tilt{.from = -180, .to = 180};
    return std::array{
        Field{"roll_amplitude_deg", &P::roll_amplitude_deg, "deg", tilt, "largest angle about x"},
        Field{"roll_period_s", &P::roll_period_s, "s", ranges::positive, "period of the roll"},
        Field{"pitch_amplitude_deg", &P::pitch_amplitude_deg, "deg", tilt, "largest angle about y"},
        Field{"pitch_period_s", &P::pitch_period_s, "s", ranges::positive, "period of the pitch"},
    };
  }

  std::array<double, 3> operator()(double t_s) const {
    constexpr double gravity_mps2 = 9.80665, radians = std::numbers::pi / 180.0;
    const double turn = 2.0 * std::numbers::pi * t_s;
    const double roll = radians * roll_amplitude_deg * std::sin(turn / roll_period_s);
    const double pitch = radians * pitch_amplitude_deg * std::sin(turn / pitch_period_s);
    return {-gravity_mps2 * std::sin(pitch), gravity_mps2 * std::sin(roll) * std::cos(pitch),
            gravity_mps2 * std::cos(roll) * std::cos(pitch)};
  }
};

}  // namespace gyrostat::acceleration
