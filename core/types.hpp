#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Core>

namespace gyrostat {

template <class T, int N>
using Vector = Eigen::Matrix<T, N, 1>;
template <class T, int Rows, int Columns = Rows>
using Matrix = Eigen::Matrix<T, Rows, Columns>;

/// A channel or a cell without a value.
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// An angle wrapped to [-180, 180) degrees.
template <class T>
T wrap_degrees(const T& angle) {
  using std::floor;
  return angle - T(360.0) * floor((angle + T(180.0)) / T(360.0));
}

}  // namespace gyrostat
