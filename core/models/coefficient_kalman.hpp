#pragma once

#include <optional>

#include <gyrostat/core/models/compass_aiding.hpp>
#include <gyrostat/core/models/thermal.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

template <class T>
struct CoefficientKalmanParameters : ThermalParameters<T>, CoefficientWalk<T> {
  static constexpr auto fields() {
    return join_fields<CoefficientKalmanParameters, T>(ThermalParameters<T>::fields(),
                                                       CoefficientWalk<T>::fields());
  }
};

/// Kalman filtering of [a, b, c] as a random walk, from y_k = [M_k, M_{k-1}, M_{k-2}] [B eq. 3-4].
/// Each M is used three times and neighbours share a compass sample, which the filter does not
/// know. Its covariance is not simply over-confident: reuse alone makes it three times too small
/// (white errors of M, NEES 3), but shared compass noise cancels in the sum of successive M, so
/// that where it dominates the covariance is far too large (NEES 0.1); where both are alike the two
/// nearly balance (`results/published/reuse_of_m`).
template <class T>
class CoefficientKalman {
 public:
  static constexpr int rows = 3;

  explicit CoefficientKalman(const CoefficientKalmanParameters<T>& p)
      : state_{p.coefficients(), p.initial_covariance()},
        Q_(CoefficientWalk<T>(p).covariance()),
        R_(Matrix<T, rows>::Identity() *
           (p.bias_measurement_std_dps * p.bias_measurement_std_dps)) {
    y_.setConstant(T(no_value));
    H_.setZero();
  }

  /// Makes room for the newest epoch and tells whether its measurement vector is complete.
  bool shift_in(const BiasEpoch<T>& epoch) {
    for (int row = rows - 1; row > 0; --row) {
      y_(row) = y_(row - 1);
      H_.row(row) = H_.row(row - 1).eval();
    }
    y_(0) = epoch.bias_dps;
    H_.row(0) = epoch.regressors.transpose();
    for (int row = 0; row < rows; ++row)
      if (is_missing(y_(row))) return false;
    return true;
  }

  void walk(const T& fading_factor) { state_.covariance = fading_factor * state_.covariance + Q_; }
  Innovation<T, rows> update() { return measurement_update<T, 3, rows>(state_, H_, R_, y_); }

  Vector<T, rows> innovation() const { return y_ - H_ * state_.mean; }
  T process_trace() const { return (H_ * Q_ * H_.transpose()).trace(); }
  T measurement_trace() const { return R_.trace(); }
  T predicted_trace() const { return (H_ * state_.covariance * H_.transpose()).trace(); }
  const Coefficients<T>& coefficients() const { return state_; }

 private:
  Coefficients<T> state_;
  Matrix<T, 3> Q_;
  Matrix<T, rows> R_;
  Vector<T, rows> y_;
  Matrix<T, rows, 3> H_;
};

}  // namespace gyrostat
