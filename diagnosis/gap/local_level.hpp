#pragma once

#include <span>
#include <vector>

#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat::gap {

/// A random walk in white noise seen at some of its points, with nothing known of where it began:
/// the local level model (Harvey, "Forecasting, Structural Time Series Models and the Kalman
/// Filter", 1989, 4.1). `ratio` is the variance of the walk's step from one point to the next over
/// that of the white noise.
class LocalLevel {
 public:
  LocalLevel(std::span<const std::size_t> points, double ratio);

  /// Of values at the points: what each but the first tells beyond those before it, of equal
  /// variance.
  Eigen::VectorXd innovations(const Eigen::VectorXd& values) const;
  Eigen::MatrixXd innovations_of_columns(const Eigen::MatrixXd& values) const;
  double log_determinant() const { return log_determinant_; }

 private:
  std::vector<double> gains_, scales_;
  double log_determinant_ = 0.0;
};

/// How likely each ratio is, by the restricted likelihood: the coefficients of `regressors` (points
/// x any) are unknown as the level is, and the white noise is concentrated out (Harvey 1989, 3.4).
class RatioLikelihood {
 public:
  RatioLikelihood(std::span<const std::size_t> points, const Eigen::MatrixXd& regressors,
                  const Eigen::VectorXd& values);

  /// -2 log of the likelihood over its largest.
  double deviance(double ratio) const;
  double most_likely() const;

 private:
  std::vector<double> deviances_;  ///< at the ratios of a logarithmic grid
};

}  // namespace gyrostat::gap
