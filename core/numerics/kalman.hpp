#pragma once

#include <gyrostat/core/numerics/full_pivots.hpp>
#include <gyrostat/core/numerics/lanes.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

/// Mean (N) and covariance (N x N) of a state.
template <class T, int N>
struct Gaussian {
  Vector<T, N> mean;
  Matrix<T, N> covariance;

  friend Gaussian select(const Mask<T>& mask, const Gaussian& yes, const Gaussian& no) {
    return {gyrostat::select(mask, yes.mean, no.mean),
            gyrostat::select(mask, yes.covariance, no.covariance)};
  }
};

/// Finite throughout, and no variance negative.
template <class T, int N>
Mask<T> is_sound(const Gaussian<T, N>& state) {
  Mask<T> sound = all_finite(state.mean) && all_finite(state.covariance);
  unrolled<N>([&]<int i>() { sound = sound && !(state.covariance(i, i) < T(0.0)); });
  return sound;
}

/// x <- F x, P <- F P F^T (Bar-Shalom, Li, Kirubarajan 2001, eq. 5.2.3-5); the process noise is
/// the caller's to add, so that a fading factor can stand between the two.
template <class T, int N>
void propagate(Gaussian<T, N>& state, const Matrix<T, N>& F) {
  state.mean = (F * state.mean).eval();
  const Matrix<T, N> FP = F * state.covariance;
  state.covariance = FP * F.transpose();
}

/// The same for a model in companion form: row 0 of F is `first`, and each other state takes the
/// value of the one before it.
template <class T, int N>
void propagate_companion(Gaussian<T, N>& state, const Vector<T, N>& first) {
  const T x = ordered_dot<T, N>(first, state.mean);
  Vector<T, N> cross;
  unrolled<N>([&]<int i>() { cross(i) = ordered_dot<T, N>(state.covariance.col(i), first); });
  unrolled<N - 1>([&]<int k>() {
    constexpr int i = N - 1 - k;
    state.mean(i) = state.mean(i - 1);
    unrolled<N - 1>([&]<int l>() {
      constexpr int j = N - 1 - l;
      state.covariance(i, j) = state.covariance(i - 1, j - 1);
    });
  });
  state.mean(0) = x;
  state.covariance(0, 0) = ordered_dot<T, N>(first, cross);
  unrolled<N - 1>(
      [&]<int i>() { state.covariance(i + 1, 0) = state.covariance(0, i + 1) = cross(i); });
}

/// Innovation (M), its covariance (M x M), and whether the update was made.
template <class T, int M>
struct Innovation {
  Vector<T, M> value = Vector<T, M>::Zero();
  Matrix<T, M> covariance = Matrix<T, M>::Zero();
  Mask<T> sound = false;
};

/// Measurement update with z = H x + v, v ~ N(0, R), in Joseph's form, which keeps P symmetric and
/// positive semidefinite (Bar-Shalom et al. 2001, eq. 5.2.3-18). A singular innovation covariance
/// leaves the state untouched and `sound` false.
template <class T, int N, int M>
Innovation<T, M> measurement_update(Gaussian<T, N>& state, const Matrix<T, M, N>& H,
                                    const Matrix<T, M>& R, const Vector<T, M>& z) {
  const Matrix<T, M, N> HP = H * state.covariance;
  Innovation<T, M> innovation{.value = z - H * state.mean, .covariance = HP * H.transpose() + R};
  Matrix<T, M, N> transposed_gain = HP;
  if (!divide_with_full_pivots<T, M, N>(innovation.covariance, transposed_gain)) return innovation;
  const Matrix<T, N, M> gain = transposed_gain.transpose();
  const Matrix<T, N> rest = Matrix<T, N>::Identity() - gain * H;
  state.mean += gain * innovation.value;
  state.covariance =
      (rest * state.covariance * rest.transpose()).eval() + gain * R * gain.transpose();
  innovation.sound = true;
  return innovation;
}

/// The same for a measurement of state 0 alone with variance r: z = x_0 + v. With gain k, p the row
/// 0 of P, and M = P - k p, Joseph's form is M - M_0 k^T + r k k^T, of which the lower half is
/// computed. Where the innovation's variance is not positive the gain is zero and `sound` false.
template <class T, int N>
Innovation<T, 1> measure_first(Gaussian<T, N>& state, const T& r, const T& z) {
  Innovation<T, 1> innovation;
  innovation.value(0) = z - state.mean(0);
  innovation.covariance(0) = state.covariance(0, 0) + r;
  const T& variance = innovation.covariance(0);
  innovation.sound = variance > T(0.0);
  const Vector<T, N> p = state.covariance.col(0);
  const T inverse = select(innovation.sound, T(T(1.0) / variance), T(0.0));
  const Vector<T, N> gain = p * inverse;
  state.mean += gain * innovation.value(0);
  const T kept = T(1.0) - gain(0);
  Vector<T, N> first;
  unrolled<N>([&]<int i>() { first(i) = i == 0 ? T(kept * p(0)) : T(p(i) - gain(i) * p(0)); });
  unrolled<N * N>([&]<int at>() {
    constexpr int i = at / N, j = at % N;
    if constexpr (i >= j) {
      const T rest = j == 0 ? first(i) : T(state.covariance(i, j) - gain(i) * p(j));
      state.covariance(i, j) = rest - first(i) * gain(j) + r * (gain(i) * gain(j));
      state.covariance(j, i) = state.covariance(i, j);
    }
  });
  return innovation;
}

}  // namespace gyrostat
