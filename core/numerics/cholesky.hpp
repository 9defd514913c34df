#pragma once

#include <gyrostat/core/numerics/lanes.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

/// Zero, and constant where T carries derivatives.
template <class T>
Mask<T> vanishing(const T& value) {
  if constexpr (requires { value.v.isZero(0.0); })
    return value.a == 0.0 && value.v.isZero(0.0);
  else
    return value == T(0.0);
}
template <class T>
bool vanishes(const T& value) {
  return all(vanishing(value));
}

/// Root of L L^T + v v^T by Givens rotations; L may be singular.
template <class T, int N>
void update_root(Matrix<T, N>& root, Vector<T, N> v) {
  using std::sqrt;
  for (int k = 0; k < N; ++k) {
    const T squared = root(k, k) * root(k, k) + v(k) * v(k);
    const Mask<T> stays = vanishing(v(k)) || squared == T(0.0);
    if (all(stays)) continue;
    const T diagonal = sqrt(squared);
    const T c = select(stays, T(1.0), T(root(k, k) / diagonal));
    const T s = select(stays, T(0.0), T(v(k) / diagonal));
    root(k, k) = select(stays, root(k, k), diagonal);
    for (int i = k + 1; i < N; ++i) {
      const T below = root(i, k);
      root(i, k) = c * below + s * v(i);
      v(i) = c * v(i) - s * below;
    }
  }
}

/// Root of (P^-1 - 2 mu e_i e_i^T)^-1 for P = L L^T. With l the row i of L that is
/// L (I - 2 mu l l^T)^-1 L^T by the Sherman-Morrison formula, and the middle matrix has the lower
/// root M_kk = sqrt(b_k / b_{k-1}), M_jk = 2 mu l_j l_k / sqrt(b_k b_{k-1}) with b_k = 1 - 2 mu
/// sum_{j > k} l_j^2 (Gill, Golub, Murray and Saunders 1974, method C1). Exists where the answer is
/// true, which is where 1 - 2 mu P_ii is positive; elsewhere `root` is of no use.
template <int i, class T, int N>
[[nodiscard]] Mask<T> inflate_along(Matrix<T, N>& root, const T& twice_mu) {
  using std::sqrt;
  const Vector<T, i + 1> l = root.row(i).template head<i + 1>().transpose();
  Vector<T, i + 1> b, per_root;  // b_k and 1 / sqrt(b_{k-1})
  T rest(1.0);
  unrolled<i + 1>([&]<int up>() {
    constexpr int k = i - up;
    b(k) = rest;
    rest -= twice_mu * (l(k) * l(k));
    per_root(k) = T(1.0) / sqrt(rest);
  });
  Vector<T, N> right = Vector<T, N>::Zero();  // sum_{j > k} L_row,j l_j
  unrolled<i + 1>([&]<int up>() {
    constexpr int k = i - up;
    T diagonal = per_root(k), below = twice_mu * l(k) * per_root(k);
    if constexpr (k < i) {
      diagonal *= b(k) * per_root(k + 1);
      below *= per_root(k + 1);
    }
    unrolled<N - k>([&]<int down>() {
      constexpr int row = k + down;
      const T entry = root(row, k);
      root(row, k) =
          k < i && row > k ? T(entry * diagonal + below * right(row)) : T(entry * diagonal);
      right(row) += entry * l(k);
    });
  });
  return rest > T(0.0);
}

/// Root of (P^-1 - 2 diag(mu))^-1 for P = L L^T, mu >= 0: the risk-sensitive update [A eq. 15], one
/// element at a time. The paper inverts the root, downdates and inverts back; this form is the same
/// matrix, needs no inverse, and stands for a singular P. False, with `root` untouched, where P^-1
/// - 2 mu is not positive definite.
template <class T, int N>
[[nodiscard]] Mask<T> inflate_root(Matrix<T, N>& root, const Vector<T, N>& mu) {
  Matrix<T, N> inflated = root;
  Mask<T> exists = true;
  unrolled<N>([&]<int i>() {
    if (!vanishes(mu(i))) exists = inflate_along<i, T, N>(inflated, T(2.0) * mu(i)) && exists;
  });
  root = select(exists, inflated, root);
  return exists;
}

}  // namespace gyrostat
