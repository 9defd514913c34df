#pragma once

#include <cmath>
#include <numbers>

#include <gyrostat/core/fields.hpp>

namespace gyrostat::temperature {

/// A thermal chamber's sinusoidal cycle, starting at the low end.
struct Cycle {
  double low_C = 23.0;
  double high_C = 57.0;
  double period_s = 3600.0;

  static constexpr std::string_view title = "sinusoidal cycle between two temperatures";

  static constexpr auto fields() {
    using P = Cycle;
    return std::array{
        Field{"low_C", &P::low_C, "°C", ranges::temperature_C, "lowest temperature"},
        Field{"high_C", &P::high_C, "°C", ranges::temperature_C, "highest temperature"},
        Field{"period_s", &P::period_s, "s", ranges::positive, "period of the cycle"},
    };
  }

  double operator()(double t_s) const {
    const double phase = 2.0 * std::numbers::pi * t_s / period_s;
    return low_C + (high_C - low_C) * 0.5 * (1.0 - std::cos(phase));
  }
};

}  // namespace gyrostat::temperature
