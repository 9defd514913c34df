#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/diagnosis/gap/local_level.hpp>

#include <algorithm>
#include <cmath>

namespace gyrostat::gap {
namespace {

constexpr double least_ratio = 1e-9, step = 0.5;  // of its logarithm
constexpr int ratios = 49;

}  // namespace

LocalLevel::LocalLevel(std::span<const std::size_t> points, double ratio) {
  double variance = 1.0;  // of the level, known from the first value
  for (std::size_t k = 1; k < points.size(); ++k) {
    variance += ratio * static_cast<double>(points[k] - points[k - 1]);
    gains_.push_back(variance / (variance + 1.0));
    scales_.push_back(1.0 / std::sqrt(variance + 1.0));
    log_determinant_ += std::log(variance + 1.0);
    variance = gains_.back();
  }
}

Eigen::VectorXd LocalLevel::innovations(const Eigen::VectorXd& values) const {
  const auto count = static_cast<Eigen::Index>(gains_.size());
  Eigen::VectorXd result(count);
  double level = count > 0 ? values[0] : 0.0;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double innovation = values[k + 1] - level;
    level += gains_[static_cast<std::size_t>(k)] * innovation;
    result[k] = scales_[static_cast<std::size_t>(k)] * innovation;
  }
  return result;
}

Eigen::MatrixXd LocalLevel::innovations_of_columns(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(gains_.size()), values.cols());
  for (Eigen::Index c = 0; c < values.cols(); ++c) result.col(c) = innovations(values.col(c));
  return result;
}

RatioLikelihood::RatioLikelihood(std::span<const std::size_t> points,
                                 const Eigen::MatrixXd& regressors, const Eigen::VectorXd& values) {
  for (int k = 0; k < ratios; ++k) {
    const LocalLevel level(points, least_ratio * std::exp(step * k));
    Eigen::VectorXd rest = level.innovations(values);
    double log_determinant = level.log_determinant();
    auto freedom = static_cast<double>(rest.size());
    if (regressors.cols() > 0) {
      const Eigen::MatrixXd of_regressors = level.innovations_of_columns(regressors);
      const auto fit = least_squares(of_regressors, rest);
      rest -= of_regressors * fit.solution;
      freedom -= static_cast<double>(fit.rank);
      for (Eigen::Index r = 0; r < fit.rank; ++r)
        log_determinant += 2.0 * std::log(std::abs(fit.pivots[r]));
    }
    deviances_.push_back(log_determinant +
                         freedom * std::log(std::max(rest.squaredNorm(), 1e-300)));
  }
  const double least = *std::min_element(deviances_.begin(), deviances_.end());
  for (double& d : deviances_) d -= least;
}

double RatioLikelihood::deviance(double ratio) const {
  const double at =
      std::clamp(std::log(std::max(ratio, 1e-300) / least_ratio) / step, 0.0, ratios - 1.000001);
  const auto low = static_cast<std::size_t>(at);
  return std::lerp(deviances_[low], deviances_[low + 1], at - static_cast<double>(low));
}

double RatioLikelihood::most_likely() const {
  const auto best = std::min_element(deviances_.begin(), deviances_.end()) - deviances_.begin();
  return least_ratio * std::exp(step * static_cast<double>(best));
}

}  // namespace gyrostat::gap
