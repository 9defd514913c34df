#include <gyrostat/analysis/fits/thermal_regression.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/models/compass_aiding.hpp>
#include <gyrostat/core/models/thermal.hpp>
#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/track.hpp>

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

/// Variances of the ordinary least squares of y = X b under white noise and a random walk that
/// starts at zero: a covariance of white (I + ratio L L^T) with L the running sum, averaged over
/// ratio by restricted likelihood (Patterson and Thompson, Biometrika 58, 1971), evenly over its
/// logarithm from less than so many rows could show.
Eigen::VectorXd least_squares_variances(const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  Eigen::MatrixXd columns(X.rows(), X.cols() + 1);
  columns << X, y;
  Eigen::MatrixXd sums = X;
  for (Eigen::Index k = X.rows() - 2; k >= 0; --k) sums.row(k) += sums.row(k + 1);
  sums.row(0).setZero();
  const Eigen::MatrixXd bread = pseudo_inverse(X.transpose() * X);
  const double n = static_cast<double>(X.rows()), freedom = n - static_cast<double>(X.cols());
  std::vector<double> deviances;
  std::vector<Eigen::VectorXd> variances;
  for (double ratio = 0.1 / (n * n); ratio < 100.0; ratio *= std::pow(10.0, 0.25)) {
    double log_variances = 0.0;
    const Eigen::MatrixXd white = whitened(columns, ratio, log_variances);
    const auto W = white.leftCols(X.cols());
    const Eigen::VectorXd w = white.rightCols(1);
    const auto fit = least_squares(W, w);
    const double white_variance = (w - W * fit.solution).squaredNorm() / freedom;
    double log_volume = 0.0;
    for (const double pivot : fit.pivots) log_volume += std::log(std::abs(pivot));
    deviances.push_back(freedom * std::log(std::max(white_variance, 1e-300)) + log_variances +
                        2.0 * log_volume);
    variances.push_back(
        white_variance *
        (bread * (X.transpose() * X + ratio * sums.transpose() * sums) * bread).diagonal());
  }
  const double least = *std::min_element(deviances.begin(), deviances.end());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(X.cols());
  double total = 0.0;
  for (std::size_t k = 0; k < deviances.size(); ++k) {
    const double weight = std::exp(-0.5 * (deviances[k] - least));
    total += weight;
    sum += weight * variances[k];
  }
  return sum / total;
}

}  // namespace

ThermalFit fit_thermal_drift(const Series& series, double interval_s) {
  const auto [X, y] = interval_means(series, interval_s);
  ThermalFit fit;
  fit.points = static_cast<std::size_t>(y.size());
  if (y.size() < 4)
    throw InputError("thermal fit", std::to_string(y.size()) + " whole intervals of " +
                                        short_number(interval_s) + " s; at least 4 are needed");
  fit.temperature_span_C = X.col(0).maxCoeff() - X.col(0).minCoeff();
  const bool assessable = fit.temperature_span_C >= least_temperature_span_C;
  const Eigen::MatrixXd judged =
      assessable ? Eigen::MatrixXd(X) : Eigen::MatrixXd(X.rightCols<1>());
  const Eigen::VectorXd values = shortest_least_squares(judged, y);
  const Eigen::VectorXd errors = least_squares_variances(judged, y).cwiseSqrt();
  fit.residual_std_dps = std::sqrt((y - judged * values).squaredNorm() /
                                   static_cast<double>(y.size() - judged.cols()));
  if (assessable) {
    fit.parameters = {values(0), values(1), values(2)};
    fit.standard_errors = {errors(0), errors(1), errors(2)};
    fit.message = "least squares";
  } else {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    fit.parameters = {0.0, 0.0, values(0)};
    fit.standard_errors = {unknown, unknown, errors(0)};
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
      residual.push_back(epoch->bias_dps - epoch->regressors.dot(coefficients_of(drift)));
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
  const Eigen::VectorXd residual = y - X.lazyProduct(coefficients_of(drift));
  return std::sqrt((residual.array() - residual.mean()).square().sum() /
                   static_cast<double>(y.size() - 1));
}

}  // namespace gyrostat
