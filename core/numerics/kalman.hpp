#pragma once

#include <Eigen/LU>

#include "core/types.hpp"

namespace gyrostat {

/// Mean (N) and covariance (N x N) of a state.
template <class T, int N>
struct Gaussian {
  Vector<T, N> mean;
  Matrix<T, N> covariance;
};

/// Finite throughout, and no variance negative.
template <class T, int N>
bool is_sound(const Gaussian<T, N>& state) {
  using std::isfinite;
  for (int i = 0; i < N; ++i) {
    if (!isfinite(state.mean(i)) || state.covariance(i, i) < T(0.0)) return false;
    for (int j = 0; j < N; ++j)
      if (!isfinite(state.covariance(i, j))) return false;
  }
  return true;
}

/// x <- F x, P <- F P F^T (Bar-Shalom, Li, Kirubarajan 2001, eq. 5.2.3-5); the process noise is
/// the caller's to add, so that a fading factor can stand between the two.
template <class T, int N>
void propagate(Gaussian<T, N>& state, const Matrix<T, N>& F) {
  state.mean = (F * state.mean).eval();
  const Matrix<T, N> FP = F * state.covariance;
  state.covariance = FP * F.transpose();
}

/// Innovation (M), its covariance (M x M), and whether the update was made.
template <class T, int M>
struct Innovation {
  Vector<T, M> value = Vector<T, M>::Zero();
  Matrix<T, M> covariance = Matrix<T, M>::Zero();
  bool sound = false;
};

/// Measurement update with z = H x + v, v ~ N(0, R), in Joseph's form, which keeps P symmetric and
/// positive semidefinite (Bar-Shalom et al. 2001, eq. 5.2.3-18). A singular innovation covariance
/// leaves the state untouched and `sound` false.
template <class T, int N, int M>
Innovation<T, M> measurement_update(Gaussian<T, N>& state, const Matrix<T, M, N>& H,
                                    const Matrix<T, M>& R, const Vector<T, M>& z) {
  const Matrix<T, M, N> HP = H * state.covariance;
  Innovation<T, M> innovation{.value = z - H * state.mean, .covariance = HP * H.transpose() + R};
  const auto lu = innovation.covariance.fullPivLu();
  if (!lu.isInvertible()) return innovation;
  const Matrix<T, N, M> gain = lu.solve(HP).transpose();
  const Matrix<T, N> rest = Matrix<T, N>::Identity() - gain * H;
  state.mean += gain * innovation.value;
  state.covariance = (rest * state.covariance * rest.transpose()).eval() +
                     gain * R * gain.transpose();
  innovation.sound = true;
  return innovation;
}

/// The same for a measurement of state 0 alone with variance r: z = x_0 + v.
template <class T, int N>
Innovation<T, 1> measure_first(Gaussian<T, N>& state, const T& r, const T& z) {
  Innovation<T, 1> innovation;
  innovation.value(0) = z - state.mean(0);
  innovation.covariance(0) = state.covariance(0, 0) + r;
  const T& variance = innovation.covariance(0);
  if (!(variance > T(0.0))) return innovation;
  const Vector<T, N> gain = state.covariance.col(0) / variance;
  state.mean += gain * innovation.value(0);
  Matrix<T, N> rest = Matrix<T, N>::Identity();
  rest.col(0) -= gain;
  state.covariance =
      (rest * state.covariance * rest.transpose()).eval() + r * (gain * gain.transpose());
  innovation.sound = true;
  return innovation;
}

}  // namespace gyrostat
