#pragma once

#include <cmath>
#include <limits>

namespace gyrostat {

/// A channel or a cell without a value.
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// An angle wrapped to [-180, 180) degrees.
template <class T>
T wrap_degrees(const T& angle) {
  using std::floor;
  return angle - T(360.0) * floor((angle + T(180.0)) / T(360.0));
}

}  // namespace gyrostat
