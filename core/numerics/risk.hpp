#pragma once

#include <gyrostat/core/numerics/cholesky.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

/// P <- (P^-1 - 2 diag(mu))^-1, mu >= 0, by one Sherman-Morrison step an element: `inflate_root` on
/// the covariance itself. False, with P untouched, where P^-1 - 2 mu is not positive definite.
template <class T, int N>
[[nodiscard]] Mask<T> inflate_covariance(Matrix<T, N>& P, const Vector<T, N>& mu) {
  Matrix<T, N> inflated = P;
  Mask<T> exists = true;
  for (int i = 0; i < N; ++i) {
    if (vanishes(mu(i))) continue;
    const Vector<T, N> p = inflated.col(i);
    const T remaining = T(1.0) - T(2.0) * mu(i) * p(i);
    exists = exists && remaining > T(0.0);
    inflated += T(2.0) * mu(i) / remaining * (p * p.transpose());
  }
  P = select(exists, inflated, P);
  return exists;
}

}  // namespace gyrostat
