#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include <gyrostat/core/models/arima111.hpp>

namespace gyrostat {

/// What the likelihood of ARIMA(1,1,1) + white noise is made of: its innovations nu with variances
/// S, of `ArimaInnovations`.
struct ArimaSums {
  double squares = 0.0;  ///< sum nu^2 / S
  double logs = 0.0;     ///< sum log S, of S in dps^2
  double count = 0.0;    ///< of terms

  /// Half of the deviance, up to a constant.
  double misfit() const { return 0.5 * (squares + logs); }
};

ArimaSums arima_sums(const Arima111<double>& arima, std::span<const double> rate_dps);

/// Of several models over one recording, in the order of the models: in a fraction of the time that
/// each takes alone.
std::vector<ArimaSums> arima_sums(std::span<const Arima111<double>> models,
                                  std::span<const double> rate_dps);

/// The sums with their derivatives by (phi, delta1, delta2, sqrt R), the first of the innovations
/// r = nu / sqrt(S) being d r = d nu / sqrt(S) - nu d S / (2 S^(3/2)).
struct ArimaDerivatives {
  ArimaSums sums;
  Eigen::Vector4d logs = Eigen::Vector4d::Zero();  ///< sum d S / S
  /// Sum of products of (d r, r).
  Eigen::Matrix<double, 5, 5> products = Eigen::Matrix<double, 5, 5>::Zero();
  /// Expected information given the innovations: sum of d nu d nu^T / S + d S d S^T / (2 S^2)
  /// (Durbin and Koopman 2012, sec. 7.3.5).
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();

  /// Of `ArimaSums::misfit`.
  Eigen::Vector4d gradient() const { return 0.5 * logs + products.col(4).head<4>(); }
};

ArimaDerivatives arima_derivatives(const Arima111<double>& arima, std::span<const double> rate_dps);
std::vector<ArimaDerivatives> arima_derivatives(std::span<const Arima111<double>> models,
                                                std::span<const double> rate_dps);

}  // namespace gyrostat
