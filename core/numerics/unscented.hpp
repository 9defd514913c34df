#pragma once

#include "core/types.hpp"

namespace gyrostat {

/// Weights of the scaled unscented transform for n states (Wan and van der Merwe 2000, eq. 15):
/// lambda = alpha^2 (n + kappa) - n, points at the mean and at mean +- spread * root columns.
template <class T>
struct UnscentedWeights {
  T spread;             ///< gamma = sqrt(n + lambda)
  T covariance_centre;  ///< W0^c, negative for a small alpha
  T other;              ///< W_i, i = 1 ... 2n; W0^m is what is left to 1

  UnscentedWeights(int n, const T& alpha, const T& beta, const T& kappa) {
    using std::sqrt;
    const T scale = alpha * alpha * (T(n) + kappa);
    spread = sqrt(scale);
    covariance_centre = T(2.0) - T(n) / scale - alpha * alpha + beta;
    other = T(0.5) / scale;
  }
};

}  // namespace gyrostat
