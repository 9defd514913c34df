#pragma once

#include <span>

#include <gyrostat/core/models/arima111.hpp>
#include <gyrostat/core/step.hpp>

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

/// The innovations of the exact state-space model, sample by sample: the terms of the diffuse
/// likelihood of ARIMA(1,1,1) + white noise (Durbin and Koopman 2012, sec. 7.2), its level unknown
/// beforehand and its first difference stationary.
///
/// Two states suffice: with d_k = x_k - x_{k-1}, the next difference is predicted by
/// e_k = phi d_k - delta2 a_k alone, so that
///   x_{k+1} = x_k + e_k + delta1 a_{k+1},  e_{k+1} = phi e_k + (phi delta1 - delta2) a_{k+1}.
/// A flat prior of the level leaves x_0 ~ N(z_0, R), independent of e_0, which is stationary. Once
/// the covariance has settled, value and derivatives, its gain is kept.
template <class T>
struct ArimaInnovations {
  ArimaInnovations(const Arima111<T>& arima, double first)
      : phi(arima.phi),
        R(arima.measurement_noise_std_dps * arima.measurement_noise_std_dps),
        x(first),
        Pxx(R) {
    const T &delta1 = arima.delta1_dps, drive = phi * delta1 - arima.delta2_dps;  // of e
    Qxx = delta1 * delta1;
    Qxe = delta1 * drive;
    Qee = drive * drive;
    Pee = Qee / (T(1.0) - phi * phi);
  }

  /// Takes the next sample of the signal. False where it is missing, and has no innovation.
  bool step(double z) {
    const bool missing = is_missing(z);
    settled = settled && !missing;
    x += e;
    e *= phi;
    if (!settled) {
      Pxx += T(2.0) * Pxe + Pee + Qxx;
      Pxe = phi * (Pxe + Pee) + Qxe;
      Pee = phi * phi * Pee + Qee;
    }
    if (missing) return false;
    if (!settled) {
      const T before = variance;
      variance = Pxx + R;
      gain_x = Pxx / variance;
      gain_e = Pxe / variance;
      settled = detail::same(before, variance);
      Pee -= gain_e * Pxe;
      Pxx = gain_x * R;
      Pxe = Pxe * R / variance;
    }
    innovation = T(z) - x;
    x += gain_x * innovation;
    e += gain_e * innovation;
    return true;
  }

  T phi, R;
  T x, e{0.0};
  T Pxx, Pxe{0.0}, Pee;
  T Qxx, Qxe, Qee;
  T gain_x{0.0}, gain_e{0.0};
  T innovation{0.0}, variance{0.0};
  bool settled = false;
};

/// Calls `use(innovation, variance)` for every sample of `z` after the first present one. NaN
/// samples are passed over.
///
/// Example: their mean square over what the model says of it, 1 where the model is true.
///
///   double sum = 0.0, count = 0.0;
///   const std::vector<double> z = {0.1, 0.2, 0.1, -0.1};
///   arima_innovations(Arima111<double>{}, z, [&](double innovation, double variance) {
///     sum += innovation * innovation / variance;
///     ++count;
///   });
template <class T, class Use>
void arima_innovations(const Arima111<T>& arima, std::span<const double> z, const Use& use) {
  std::size_t first = 0;
  while (first < z.size() && is_missing(z[first])) ++first;
  if (first == z.size()) return;
  ArimaInnovations<T> at(arima, z[first]);
  for (const double sample : z.subspan(first + 1))
    if (at.step(sample)) use(at.innovation, at.variance);
}

}  // namespace gyrostat
