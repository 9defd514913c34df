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

/// Covariance of least squares under autocorrelated residuals, Bartlett weights up to `lags`.
Eigen::Matrix3d newey_west(const Eigen::MatrixX3d& X, const Eigen::VectorXd& residual,
                           Eigen::Index lags, int parameters) {
  const Eigen::MatrixX3d scores = residual.asDiagonal() * X;
  Eigen::Matrix3d middle = scores.transpose() * scores;
  for (Eigen::Index lag = 1; lag <= lags; ++lag) {
    const double weight = 1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1);
    const Eigen::Matrix3d cross =
        scores.bottomRows(X.rows() - lag).transpose() * scores.topRows(X.rows() - lag);
    middle += weight * (cross + cross.transpose());
  }
  const Eigen::Matrix3d bread = (X.transpose() * X).completeOrthogonalDecomposition().pseudoInverse();
  const double n = static_cast<double>(X.rows());
  return n / (n - parameters) * bread * middle * bread;
}

}  // namespace

ThermalFit fit_thermal_drift(const Series& series, double interval_s) {
  auto [X, y] = interval_means(series, interval_s);
  ThermalFit fit;
  fit.points = static_cast<std::size_t>(y.size());
  if (y.size() < 4)
    throw InputError("thermal fit", std::to_string(y.size()) + " whole intervals of " +
                                        std::to_string(interval_s) + " s; at least 4 are needed");
  fit.temperature_span_C = X.col(0).maxCoeff() - X.col(0).minCoeff();
  const bool assessable = fit.temperature_span_C >= least_temperature_span_C;
  if (!assessable) X.leftCols<2>().setZero();

  const Eigen::Vector3d solution = X.completeOrthogonalDecomposition().solve(y);
  const Eigen::VectorXd residual = y - X * solution;
  const int parameters = assessable ? 3 : 1;
  const auto lags = static_cast<Eigen::Index>(
      std::floor(4.0 * std::pow(static_cast<double>(y.size()) / 100.0, 2.0 / 9.0)));
  const Eigen::Vector3d errors =
      newey_west(X, residual, std::min(lags, y.size() - 2), parameters).diagonal().cwiseSqrt();
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
