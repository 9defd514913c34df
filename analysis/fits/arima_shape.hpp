#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/models/arima111.hpp>

namespace gyrostat {

/// What a fit by likelihood moves: phi and theta = delta2 / delta1 are tanh of the first two,
/// sqrt(R) / delta1 is exp of the third. The scale, delta1, is found in closed form.
using ArimaShape = std::array<double, 3>;

struct ArimaLimits {
  static constexpr double shape = 6.0;  ///< |phi|, |theta| < 1 - 1.2e-5
  static constexpr double log_ratio = 12.0;
};

/// The model with delta1 = 1.
template <class T>
Arima111<T> unit_arima(const T* shape) {
  using std::exp;
  using std::tanh;
  const T phi = tanh(shape[0]);
  const T theta = tanh(shape[1]);
  return {phi, T(1.0), theta, exp(shape[2])};
}

/// Which of phi, theta and R a model leaves free; the others are zero.
struct ArimaVariant {
  bool phi, theta, noise;
  const char* message;

  int held() const { return !phi + !theta + !noise; }
};

}  // namespace gyrostat
