#pragma once

#include <optional>

#include <gyrostat/core/models/compass_aiding.hpp>
#include <gyrostat/core/models/fading.hpp>
#include <gyrostat/core/models/thermal.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

template <class T>
struct CoefficientKalmanMaParameters : ThermalParameters<T>,
                                       CoefficientWalk<T>,
                                       FadingParameters<T> {
  T compass_noise_std_deg{0.05};

  static constexpr auto fields() {
    using P = CoefficientKalmanMaParameters;
    return join_fields<P, T>(
        ThermalParameters<T>::fields(), CoefficientWalk<T>::fields(), FadingParameters<T>::fields(),
        std::array{Field{"compass_noise_std_deg", &P::compass_noise_std_deg, "deg",
                         ranges::non_negative, "standard deviation of one compass reading"}});
  }
};

/// Kalman filtering of [a, b, c] as a random walk from each bias measurement once, with the error
/// that it has: neighbouring measurements share a compass reading, so that
///   M_k = [T_k, T'_k, 1] X - n_k + n_{k-1} + w_k,
/// n_k the compass noise over the interval's length and w_k white, a moving average. The state
/// [a, b, c, n_k, n_{k-1}] carries n. Of the variance of M, w has what the compass leaves, and at
/// least a hundredth: the difference of two estimates should not claim to be nothing.
template <class T>
class CoefficientKalmanMa {
 public:
  explicit CoefficientKalmanMa(const CoefficientKalmanMaParameters<T>& p) : fading_(p) {
    const T n = p.compass_noise_std_deg / p.update_interval_s;
    const T total = p.bias_measurement_std_dps * p.bias_measurement_std_dps;
    const T white = total - T(2.0) * n * n, least = T(0.01) * total;
    R_(0, 0) = white > least ? white : least;
    F_.template topLeftCorner<3, 3>().setIdentity();
    F_(4, 3) = T(1.0);
    Q_.template topLeftCorner<3, 3>() = CoefficientWalk<T>(p).covariance();
    Q_(3, 3) = n * n;
    state_.mean << p.coefficients(), T(0.0), T(0.0);
    state_.covariance.template topLeftCorner<3, 3>() = p.initial_covariance();
    state_.covariance(3, 3) = n * n;
  }

  /// One interval. Without a measurement only time passes: what n was then, no later M depends on.
  std::optional<Innovation<T, 1>> update(const BiasEpoch<T>& epoch) {
    propagate(state_, F_);
    if (!epoch.is_valid()) {
      state_.covariance += Q_;
      return std::nullopt;
    }
    Matrix<T, 1, 5> H;
    H << epoch.regressors.transpose(), T(-1.0), T(1.0);
    const Vector<T, 1> M(epoch.bias_dps);
    fade(H, M(0) - (H * state_.mean)(0));
    state_.covariance += Q_;
    return measurement_update<T, 5, 1>(state_, H, R_, M);
  }

  Coefficients<T> coefficients() const {
    return {state_.mean.template head<3>(), state_.covariance.template topLeftCorner<3, 3>()};
  }

 private:
  /// Raises the variance of h X by the fading factor, h = [T, T', 1], and leaves what this
  /// measurement does not see alone (directional forgetting, Kulhavy and Karny 1984): P <- P +
  /// (factor - 1) P h h^T P / (h^T P h). Fading all of P, as [B eq. 6] does, opens directions that
  /// only the next long disturbance will ask for. The compass noise is known and does not fade: it
  /// is part of the measurement's, softened with R.
  void fade(const Matrix<T, 1, 5>& H, const T& innovation) {
    auto P = state_.covariance.template topLeftCorner<3, 3>();
    const Vector<T, 3> h = H.template leftCols<3>().transpose(), p = P * h;
    const T seen = h.dot(p);
    const T noise = state_.covariance(4, 4) + Q_(3, 3);
    const T rest = (H * (state_.covariance + Q_) * H.transpose())(0) - seen - noise;
    const T factor = fading_.next(innovation * innovation, rest, R_(0, 0) + noise, seen);
    if (seen > T(0.0)) P += (factor - T(1.0)) / seen * (p * p.transpose());
  }

  FadingFactor<T> fading_;
  Gaussian<T, 5> state_{Vector<T, 5>::Zero(), Matrix<T, 5>::Zero()};
  Matrix<T, 5> F_ = Matrix<T, 5>::Zero();
  Matrix<T, 5> Q_ = Matrix<T, 5>::Zero();
  Matrix<T, 1> R_;
};

}  // namespace gyrostat
