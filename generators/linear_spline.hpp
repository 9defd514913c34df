#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace gyrostat {

/// On straight lines between values at knots (de Boor, "A Practical Guide to Splines", 1978, ch.
/// II). `place` counts knots, from 0 at the first to the number of the last.
template <std::size_t knots>
double between_knots(const std::array<double, knots>& values, double place) {
  const auto below = std::min(static_cast<std::size_t>(place), knots - 2);
  return values[below] + (place - static_cast<double>(below)) * (values[below + 1] - values[below]);
}

/// Nine even knots, and the values of the ends beyond them.
struct LinearSpline {
  static constexpr std::size_t knots = 9;

  double from;  ///< the first knot
  double span;  ///< from it to the last, above 0
  std::array<double, knots> values;

  /// The value at x; 0 where x is unknown.
  double operator()(double x) const {
    constexpr double last = knots - 1;
    if (!std::isfinite(x)) return 0.0;
    return between_knots(values, std::clamp((x - from) / span * last, 0.0, last));
  }
};

}  // namespace gyrostat
