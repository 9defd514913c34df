#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

/// X <- A^-1 X of a small A (M x M), X (M x N), by Gaussian elimination with full pivots (Golub and
/// Van Loan 2013, sec. 3.4.8). False where A is singular: where a pivot is not above M machine
/// epsilons of the largest. Eigen's FullPivLU, to the bit, without its templates for blocks of any
/// size, which take long to compile.
template <class T, int M, int N>
bool divide_with_full_pivots(Matrix<T, M> A, Matrix<T, M, N>& X) {
  using std::abs;
  std::array<int, M> state{};  // which one stands in column k
  for (int k = 0; k < M; ++k) state[k] = k;
  const auto exchange = [](auto& m, int i, int j, int k, int l) {
    const T kept = m(i, j);
    m(i, j) = m(k, l);
    m(k, l) = kept;
  };
  T largest(0.0);
  for (int k = 0; k < M; ++k) {
    int row = k, column = k;
    for (int j = k; j < M; ++j)
      for (int i = k; i < M; ++i)
        if (abs(A(i, j)) > abs(A(row, column))) row = i, column = j;
    const T size = abs(A(row, column));
    if (size == T(0.0)) return false;
    if (size > largest) largest = size;
    for (int j = 0; j < M && row != k; ++j) exchange(A, k, j, row, j);
    for (int j = 0; j < N && row != k; ++j) exchange(X, k, j, row, j);
    for (int i = 0; i < M && column != k; ++i) exchange(A, i, k, i, column);
    std::swap(state[k], state[column]);
    for (int i = k + 1; i < M; ++i) {
      A(i, k) /= A(k, k);
      for (int j = k + 1; j < M; ++j) A(i, j) -= A(i, k) * A(k, j);
    }
  }
  const T least = largest * T(std::numeric_limits<double>::epsilon() * M);
  for (int k = 0; k < M; ++k)
    if (!(abs(A(k, k)) > least)) return false;

  Matrix<T, M, N> solution;
  for (int j = 0; j < N; ++j) {
    for (int k = 0; k < M; ++k)
      for (int i = k + 1; i < M; ++i) X(i, j) -= X(k, j) * A(i, k);
    for (int k = M - 1; k >= 0; --k) {
      X(k, j) *= T(1.0) / A(k, k);
      for (int i = 0; i < k; ++i) X(i, j) -= X(k, j) * A(i, k);
      solution(state[k], j) = X(k, j);
    }
  }
  X = solution;
  return true;
}

}  // namespace gyrostat
