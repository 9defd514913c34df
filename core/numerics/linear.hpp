#pragma once

#include <Eigen/Core>

#include <gyrostat/core/numerics/lanes.hpp>

namespace gyrostat {

template <class T, int N>
using Vector = Eigen::Matrix<T, N, 1>;
template <class T, int Rows, int Columns = Rows>
using Matrix = Eigen::Matrix<T, Rows, Columns>;

template <class T, int Rows, int Columns>
Matrix<T, Rows, Columns> select(bool mask, const Eigen::Matrix<T, Rows, Columns>& yes,
                                const Eigen::Matrix<T, Rows, Columns>& no) {
  return mask ? yes : no;
}
template <class M, class T, int Rows, int Columns>
requires(!std::same_as<M, bool>) Matrix<T, Rows, Columns> select(
    const M& mask, const Eigen::Matrix<T, Rows, Columns>& yes,
    const Eigen::Matrix<T, Rows, Columns>& no) {
  Matrix<T, Rows, Columns> out;
  unrolled<Rows * Columns>([&]<int i>() {
    out.coeffRef(i % Rows, i / Rows) =
        select(mask, yes.coeff(i % Rows, i / Rows), no.coeff(i % Rows, i / Rows));
  });
  return out;
}

/// The sum of products from the first to the last, an order that does not depend on T as that of
/// Eigen's reductions does.
template <class T, int N>
T ordered_dot(const Eigen::Matrix<T, N, 1>& a, const Eigen::Matrix<T, N, 1>& b) {
  T sum = a(0) * b(0);
  unrolled<N - 1>([&]<int i>() { sum += a(i + 1) * b(i + 1); });
  return sum;
}

/// Whether every element is finite: judged by their sum, which must not overflow either.
template <class T, int Rows, int Columns>
Mask<T> all_finite(const Eigen::Matrix<T, Rows, Columns>& m) {
  using std::isfinite;
  T sum = m(0, 0);
  unrolled<Rows * Columns - 1>([&]<int i>() { sum += m((i + 1) % Rows, (i + 1) / Rows); });
  return isfinite(sum);
}

}  // namespace gyrostat
