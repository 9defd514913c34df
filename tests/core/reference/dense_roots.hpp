#pragma once

#include <gyrostat/core/numerics/cholesky.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat::reference {

/// Lower triangular L (N x N) with L L^T = A A^T, by Householder reflections of A's rows
/// (N x M, M >= N): the QR decomposition of A^T without its Q. A row without a remainder gets a
/// zero diagonal and leaves its column of A to the next, so that L stays downdatable where A A^T
/// is singular.
template <class T, int N, int M>
Matrix<T, N> lower_root(Matrix<T, N, M> a) {
  using std::sqrt;
  Matrix<T, N> root = Matrix<T, N>::Zero();
  for (int k = 0, pivot = 0; k < N; ++k) {
    T tail(0.0);
    bool reduced = true;  // a zero whose derivative is none still turns the rows below
    for (int j = pivot + 1; j < M; ++j) {
      tail += a(k, j) * a(k, j);
      reduced = reduced && vanishes(a(k, j));
    }
    const T squared = tail + a(k, pivot) * a(k, pivot);
    if (squared == T(0.0)) continue;
    if (!reduced) {
      const T norm = sqrt(squared);
      const T head = a(k, pivot) > T(0.0) ? a(k, pivot) + norm : a(k, pivot) - norm;
      const T scale = T(2.0) / (tail + head * head);
      for (int i = k + 1; i < N; ++i) {
        T dot = a(i, pivot) * head;
        for (int j = pivot + 1; j < M; ++j) dot += a(i, j) * a(k, j);
        dot *= scale;
        a(i, pivot) -= dot * head;
        for (int j = pivot + 1; j < M; ++j) a(i, j) -= dot * a(k, j);
      }
      a(k, pivot) = a(k, pivot) > T(0.0) ? -norm : norm;
    }
    for (int i = k; i < N; ++i) root(i, k) = a(i, pivot);
    ++pivot;
  }
  return root;
}

/// Root of L L^T - v v^T by hyperbolic rotations. False, with `root` untouched, where the
/// difference is not positive definite (in v's directions, where L is singular).
template <class T, int N>
[[nodiscard]] bool downdate_root(Matrix<T, N>& root, Vector<T, N> v) {
  using std::sqrt;
  Matrix<T, N> down = root;
  for (int k = 0; k < N; ++k) {
    if (vanishes(v(k))) continue;
    const T squared = (down(k, k) - v(k)) * (down(k, k) + v(k));
    if (!(squared > T(0.0))) return false;
    const T diagonal = sqrt(squared);
    const T c = diagonal / down(k, k);
    const T s = v(k) / down(k, k);
    down(k, k) = diagonal;
    for (int i = k + 1; i < N; ++i) {
      down(i, k) = (down(i, k) - s * v(i)) / c;
      v(i) = c * v(i) - s * down(i, k);
    }
  }
  root = down;
  return true;
}

}  // namespace gyrostat::reference
