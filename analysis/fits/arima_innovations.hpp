#pragma once

#include <span>

#include "core/models/model_l.hpp"
#include "core/numerics/kalman.hpp"
#include "core/step.hpp"

namespace gyrostat {

namespace detail {

inline bool same(double a, double b) {
  using std::abs;
  return abs(a - b) <= 1e-12 * (abs(a) + abs(b));
}

/// Of a value and all its derivatives.
template <class Jet>
bool same(const Jet& a, const Jet& b) {
  for (int i = 0; i < a.v.size(); ++i)
    if (std::abs(a.v[i] - b.v[i]) > 1e-12 * (std::abs(a.a) + std::abs(a.v[i]))) return false;
  return same(a.a, b.a);
}

}  // namespace detail

/// Calls `use(innovation, variance)` for every sample of `z` after the first present one, with the
/// innovations of the exact state-space model: the terms of the diffuse likelihood of
/// ARIMA(1,1,1) + white noise (Durbin and Koopman 2012, sec. 7.2), its level unknown beforehand and
/// its first difference stationary. NaN samples are passed over.
///
/// Conditioning a flat prior of the level on z_0 leaves x_0 ~ N(z_0, R), independent of the
/// difference d_0 = x_0 - x_{-1} and of a_0, which is where the recursion starts. Once the
/// covariance has settled, value and derivatives, its gain is kept.
template <class T, class Use>
void arima_innovations(const Arima111<T>& arima, std::span<const double> z, const Use& use) {
  std::size_t first = 0;
  while (first < z.size() && is_missing(z[first])) ++first;
  if (first == z.size()) return;

  const ModelExact<T> model(arima);
  const T &phi = arima.phi, &delta1 = arima.delta1_dps, &delta2 = arima.delta2_dps;
  const T difference_variance =
      (delta1 * delta1 + delta2 * delta2 - T(2.0) * phi * delta1 * delta2) / (T(1.0) - phi * phi);
  Gaussian<T, 3> state;
  state.mean << T(z[first]), T(z[first]), T(0.0);
  state.covariance << model.R, model.R, T(0.0),              //
      model.R, model.R + difference_variance, -delta1,       //
      T(0.0), -delta1, T(1.0);

  bool settled = false;
  Vector<T, 3> gain = Vector<T, 3>::Zero();
  T variance(0.0);
  for (std::size_t k = first + 1; k < z.size(); ++k) {
    const bool missing = is_missing(z[k]);
    if (settled && !missing) {
      const T before = state.mean(0);
      state.mean(0) += phi * (before - state.mean(1)) - delta2 * state.mean(2);
      state.mean(1) = before;
      state.mean(2) = T(0.0);
      const T innovation = T(z[k]) - state.mean(0);
      state.mean += gain * innovation;
      use(innovation, variance);
      continue;
    }
    settled = false;
    propagate(state, model.F);
    state.covariance += model.Q;
    if (missing) continue;
    const Vector<T, 3> column = state.covariance.col(0);
    const auto innovation = measure_first(state, model.R, T(z[k]));
    if (!innovation.sound) continue;
    settled = detail::same(variance, innovation.covariance(0));
    variance = innovation.covariance(0);
    gain = column / variance;
    use(innovation.value(0), variance);
  }
}

}  // namespace gyrostat
