#pragma once

#include <gyrostat/core/models/arima111.hpp>

namespace gyrostat {

/// ARIMA(1,1,1) + white noise filtered in two states. With d_k = x_k - x_{k-1} the next difference
/// is predicted by e_k = phi d_k - delta2 a_k alone, so that
///   x_{k+1} = x_k + e_k + delta1 a_{k+1},  e_{k+1} = phi e_k + (phi delta1 - delta2) a_{k+1}:
/// the filter of ModelExact with a third of the work.
template <class T>
struct ArimaMinimal {
  T x, e;
  T Pxx, Pxe, Pee;

  /// From a prior of x_0 and x_{-1}, and a_0 ~ N(0, 1).
  template <class P>
  ArimaMinimal(const Arima111<T>& arima, const InitialRandomError<P>& prior)
      : x(prior.initial_x_dps),
        e(arima.phi * T(prior.initial_x_dps - prior.initial_x_previous_dps)),
        Pxx(prior.initial_x_std_dps * prior.initial_x_std_dps),
        Pxe(arima.phi * Pxx),
        Pee(arima.phi * arima.phi *
                (Pxx + T(prior.initial_x_previous_std_dps * prior.initial_x_previous_std_dps)) +
            arima.delta2_dps * arima.delta2_dps) {}

  void predict(const Arima111<T>& arima) {
    const T& phi = arima.phi;
    const T& delta1 = arima.delta1_dps;
    const T drive = phi * delta1 - arima.delta2_dps;
    x += e;
    e *= phi;
    Pxx += Pxe + Pxe + Pee + delta1 * delta1;
    Pxe = phi * (Pxe + Pee) + delta1 * drive;
    Pee = phi * phi * Pee + drive * drive;
  }

  /// The covariance after z = x + v, v ~ N(0, R), with S = Pxx + R.
  void condition(const T& R, const T& S) {
    Pee -= Pxe * Pxe / S;
    Pxx *= R / S;
    Pxe *= R / S;
  }
};

}  // namespace gyrostat
