#include "analysis/fits/thermal_regression.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "core/models/compass_aiding.hpp"
#include "core/track.hpp"

namespace gyrostat {
namespace {

constexpr double least_temperature_span_C = 1.0;

struct Regression {
  Eigen::MatrixX3d regressors;  ///< rows [T, T', 1]
  Eigen::VectorXd bias_dps;
};

/// The epochs of `interval_s` whose interval has a value of `Bias` to offer.
template <class Bias>
Regression collect(const Series& series, double interval_s, const Bias& bias) {
  std::vector<Vector<double, 3>> rows;
  std::vector<double> values;
  CompassAiding<double> aiding(interval_s);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const auto epoch = aiding.observe(sample_at(series, i), 0.0);
    const double value = bias(i, epoch);
    if (!epoch || std::isnan(value)) continue;
    rows.push_back(epoch->regressors);
    values.push_back(value);
  }
  Regression regression{Eigen::MatrixX3d(rows.size(), 3), Eigen::VectorXd(rows.size())};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    regression.regressors.row(k) = rows[k].transpose();
    regression.bias_dps(k) = values[k];
  }
  return regression;
}

/// Mean rate error over each interval.
Regression interval_means(const Series& series, double interval_s) {
  double sum = 0.0;
  std::size_t count = 0;
  return collect(series, interval_s, [&](std::size_t i, const auto& epoch) {
    const double rate = series.rate_ref_dps.empty() ? 0.0 : series.rate_ref_dps[i];
    const double error = series.gyro_dps[i] - rate;
    if (i > 0 && !std::isnan(error)) {
      sum += error;
      ++count;
    }
    if (!epoch) return no_value;
    const double mean = count == 0 ? no_value : sum / static_cast<double>(count);
    sum = 0.0;
    count = 0;
    return mean;
  });
}

/// Columns as innovations of a local-level model, a random walk of variance `ratio` per row in unit
/// white noise that starts at zero; `log_variances` gets the sum of the logs of their variances.
Eigen::MatrixXd whitened(const Eigen::MatrixXd& columns, double ratio, double& log_variances) {
  Eigen::MatrixXd out(columns.rows(), columns.cols());
  Eigen::RowVectorXd level = Eigen::RowVectorXd::Zero(columns.cols());
  double p = 0.0;
  log_variances = 0.0;
  for (Eigen::Index k = 0; k < columns.rows(); ++k) {
    const double variance = p + 1.0;
    out.row(k) = (columns.row(k) - level) / std::sqrt(variance);
    log_variances += std::log(variance);
    level += p / variance * (columns.row(k) - level);
    p = p / variance + ratio;
  }
  return out;
}

/// Residuals that wander: white variance and variance of the random walk's step over that.
struct Wander {
  double white_variance;
  double ratio;
};

/// The most likely wander of y - X b, b profiled out, on a logarithmic grid.
Wander most_likely_wander(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, int parameters) {
  Eigen::MatrixXd columns(X.rows(), X.cols() + 1);
  columns << X, y;
  const double n = static_cast<double>(X.rows());
  Wander best{};
  double best_deviance = std::numeric_limits<double>::infinity();
  for (int step = -1; step <= 40; ++step) {
    const double ratio = step < 0 ? 0.0 : std::pow(10.0, -5.0 + 0.25 * step);
    double log_variances = 0.0;
    const Eigen::MatrixXd white = whitened(columns, ratio, log_variances);
    const auto W = white.leftCols(X.cols());
    const Eigen::VectorXd w = white.rightCols(1);
    const double squares = (w - W * W.completeOrthogonalDecomposition().solve(w)).squaredNorm();
    const double deviance = n * std::log(squares / n) + log_variances;
    if (deviance < best_deviance) {
      best_deviance = deviance;
      best = {squares / (n - parameters), ratio};
    }
  }
  return best;
}

/// Covariance of ordinary least squares under such residuals: their covariance is
/// white (I + ratio L L^T) with L the running sum.
Eigen::MatrixXd least_squares_covariance(const Eigen::MatrixXd& X, const Wander& wander) {
  Eigen::MatrixXd sums = X;
  for (Eigen::Index k = X.rows() - 2; k >= 0; --k) sums.row(k) += sums.row(k + 1);
  sums.row(0).setZero();
  const Eigen::MatrixXd bread =
      (X.transpose() * X).completeOrthogonalDecomposition().pseudoInverse();
  return wander.white_variance * bread *
         (X.transpose() * X + wander.ratio * sums.transpose() * sums) * bread;
}

}  // namespace

ThermalFit fit_thermal_drift(const Series& series, double interval_s) {
  auto [X, y] = interval_means(series, interval_s);
  ThermalFit fit;
  fit.points = static_cast<std::size_t>(y.size());
  if (y.size() < 4)
    throw InputError("thermal fit", std::to_string(y.size()) + " whole intervals of " +
                                        short_number(interval_s) + " s; at least 4 are needed");
  fit.temperature_span_C = X.col(0).maxCoeff() - X.col(0).minCoeff();
  const bool assessable = fit.temperature_span_C >= least_temperature_span_C;
  if (!assessable) X.leftCols<2>().setZero();

  const Eigen::Vector3d solution = X.completeOrthogonalDecomposition().solve(y);
  const Eigen::VectorXd residual = y - X * solution;
  const int parameters = assessable ? 3 : 1;
  const Eigen::Vector3d errors =
      least_squares_covariance(X, most_likely_wander(X, y, parameters)).diagonal().cwiseSqrt();
  fit.parameters = {solution(0), solution(1), solution(2)};
  fit.standard_errors = {errors(0), errors(1), errors(2)};
  fit.residual_std_dps =
      std::sqrt(residual.squaredNorm() / static_cast<double>(y.size() - parameters));
  fit.message = "least squares";
  if (!assessable) {
    fit.standard_errors.a_dps_per_C = fit.standard_errors.b_dps_s_per_C =
        std::numeric_limits<double>::infinity();
    fit.message = "the temperature spans less than 1 °C: a and b are not assessable";
  }
  return fit;
}

double compass_noise_std(const Series& series, const ThermalDrift<double>& drift,
                         double interval_s) {
  std::vector<double> residual;
  CompassAiding<double> aiding(interval_s);
  for (std::size_t i = 0; i < series.size(); ++i)
    if (const auto epoch = aiding.observe(sample_at(series, i), 0.0))
      residual.push_back(epoch->bias_dps - epoch->regressors.dot(drift.coefficients()));
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t k = 3; k < residual.size(); ++k) {
    const double product = (residual[k] - residual[k - 1]) * (residual[k - 2] - residual[k - 3]);
    if (std::isnan(product)) continue;
    sum += product;
    ++count;
  }
  if (count == 0) return no_value;
  return interval_s * std::sqrt(std::max(0.0, sum / static_cast<double>(count)));
}

double bias_measurement_std(const Series& series, const ThermalDrift<double>& drift,
                            double interval_s) {
  if (series.heading_deg.empty()) return no_value;
  const auto [X, y] = collect(series, interval_s, [](std::size_t, const auto& epoch) {
    return epoch ? epoch->bias_dps : no_value;
  });
  if (y.size() < 2) return no_value;
  const Eigen::VectorXd residual = y - X * drift.coefficients();
  return std::sqrt((residual.array() - residual.mean()).square().sum() /
                   static_cast<double>(y.size() - 1));
}

}  // namespace gyrostat
