#pragma once

#include <concepts>
#include <utility>

#include "core/types.hpp"

namespace gyrostat {

/// `body<i>()` for i = 0 ... N - 1: a loop that is unrolled before the compiler decides what stays
/// in registers.
template <int N, class Body>
[[gnu::always_inline]] inline void unrolled(const Body& body) {
  [&]<int... i>(std::integer_sequence<int, i...>) { (body.template operator()<i>(), ...); }
  (std::make_integer_sequence<int, N>{});
}

/// What a comparison of two T gives. A number stands alone and answers with a bool; a pack (see
/// core/packed/pack.hpp) is several numbers side by side and answers with a mask.
template <class T>
struct MaskOf {
  using type = bool;
};
template <class T>
using Mask = typename MaskOf<T>::type;

inline bool any(bool mask) { return mask; }
inline bool all(bool mask) { return mask; }

/// `yes` where the mask holds, else `no`: the branch of a kernel that also runs on packs.
template <class T>
T select(bool mask, const T& yes, const T& no) {
  return mask ? yes : no;
}

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
