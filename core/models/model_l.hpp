#pragma once

#include <gyrostat/core/models/arima111.hpp>
#include <gyrostat/core/numerics/kalman.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

/// Model L of [A]: X = [x_k, x_{k-1}], F = [[1 + phi, -phi], [1, 0]], G = [[delta1, -delta2], [0,
/// 0]] and W = [a_k, a_{k-1}] taken as fresh noise at each step, z = x + v.
template <class T>
struct ModelL {
  static constexpr int states = 2;
  Vector<T, 2> first;  ///< row 0 of F, which is in companion form
  T q;                 ///< variance of the noise on x_k, all of Q = G G^T
  T R;

  explicit ModelL(const Arima111<T>& arima)
      : first(T(1.0) + arima.phi, -arima.phi),
        q(arima.delta1_dps * arima.delta1_dps + arima.delta2_dps * arima.delta2_dps),
        R(arima.measurement_noise_std_dps * arima.measurement_noise_std_dps) {}

  void predict(Vector<T, 2>& mean) const {
    const T x = ordered_dot<T, 2>(first, mean);
    mean(1) = mean(0);
    mean(0) = x;
  }
  void predict(Gaussian<T, 2>& state) const {
    propagate_companion(state, first);
    state.covariance(0, 0) += q;
  }

  static Gaussian<T, 2> initial(const InitialRandomError<T>& prior) {
    Gaussian<T, 2> state{{prior.initial_x_dps, prior.initial_x_previous_dps}, Matrix<T, 2>::Zero()};
    state.covariance(0, 0) = prior.initial_x_std_dps * prior.initial_x_std_dps;
    state.covariance(1, 1) = prior.initial_x_previous_std_dps * prior.initial_x_previous_std_dps;
    return state;
  }
};

/// The model without the approximation: X = [x_k, x_{k-1}, a_k] carries a_k, so that a_{k-1} of the
/// next step is the one that was drawn. F = [[1 + phi, -phi, -delta2], [1, 0, 0], [0, 0, 0]],
/// driven by [delta1, 0, 1] a_k.
template <class T>
struct ModelExact {
  static constexpr int states = 3;
  Vector<T, 3> first;  ///< row 0 of F
  T delta1;
  T R;

  explicit ModelExact(const Arima111<T>& arima)
      : first(T(1.0) + arima.phi, -arima.phi, -arima.delta2_dps),
        delta1(arima.delta1_dps),
        R(arima.measurement_noise_std_dps * arima.measurement_noise_std_dps) {}

  void predict(Vector<T, 3>& mean) const {
    const T x = ordered_dot<T, 3>(first, mean), previous = mean(0);
    mean << x, previous, T(0.0);
  }
  /// x <- F x, P <- F P F^T + Q.
  void predict(Gaussian<T, 3>& state) const {
    const T variance = state.covariance(0, 0);
    Vector<T, 3> cross;
    unrolled<3>([&]<int i>() { cross(i) = ordered_dot<T, 3>(state.covariance.col(i), first); });
    predict(state.mean);
    state.covariance << ordered_dot<T, 3>(first, cross) + delta1 * delta1, cross(0), delta1,  //
        cross(0), variance, T(0.0),                                                           //
        delta1, T(0.0), T(1.0);
  }

  static Gaussian<T, 3> initial(const InitialRandomError<T>& prior) {
    const auto pair = ModelL<T>::initial(prior);
    Gaussian<T, 3> state{{pair.mean(0), pair.mean(1), T(0.0)}, Matrix<T, 3>::Zero()};
    state.covariance.template topLeftCorner<2, 2>() = pair.covariance;
    state.covariance(2, 2) = T(1.0);
    return state;
  }
};

}  // namespace gyrostat
