#pragma once

#include <gyrostat/core/numerics/lanes.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

/// The scaled unscented transform (Wan and van der Merwe 2000, eq. 15) of n states by a function
/// with one nonlinear component, and that quadratic, so that at each pair of points mean +- gamma
/// L_i it departs from linearity by the same gamma^2 q_i, q_i its second-order part along column
/// L_i.
///
/// With lambda = alpha^2 (n + kappa) - n, gamma^2 = n + lambda, W_i = 1 / (2 gamma^2) and W0^c =
/// lambda / gamma^2 + 1 - alpha^2 + beta, the weighted sums over all 2n + 1 points come to: the
/// mean is that of the central point plus q = sum q_i; the covariance is that of the linear part,
/// to which the odd parts of the pairs add up, plus on the component itself
///   sum 2 W_i (gamma^2 q_i - q)^2 + W0^c q^2 = gamma^2 sum q_i^2 + (beta - alpha^2) q^2.
template <class T>
struct UnscentedQuadratic {
  T pairs;   ///< gamma^2 = alpha^2 (n + kappa)
  T centre;  ///< beta - alpha^2

  UnscentedQuadratic(int n, const T& alpha, const T& beta, const T& kappa)
      : pairs(alpha * alpha * (T(n) + kappa)), centre(beta - alpha * alpha) {}

  /// What the q_i add to the component's mean.
  template <int N>
  static T shift(const Vector<T, N>& q) {
    return ordered_dot<T, N>(q, Vector<T, N>::Ones());
  }
  /// What they add to its variance.
  template <int N>
  T variance(const Vector<T, N>& q) const {
    const T mean = shift<N>(q);
    return pairs * ordered_dot<T, N>(q, q) + centre * (mean * mean);
  }
};

}  // namespace gyrostat
