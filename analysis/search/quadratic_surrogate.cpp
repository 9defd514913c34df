#include <gyrostat/analysis/search/quadratic_surrogate.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/analysis/search/covariance_search.hpp>
#include <gyrostat/core/numerics/dense.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t most_with_products = 6;
/// Of the largest entry of the normal equations: keeps what the points do not tell near 0.
constexpr double ridge = 1e-8;

/// 1, u_i, u_i², u_i u_j.
Eigen::VectorXd terms_of(const std::vector<double>& point, const std::vector<double>& centre,
                         double radius) {
  const std::size_t n = point.size();
  Eigen::VectorXd terms(static_cast<Eigen::Index>(surrogate_terms(n)));
  Eigen::Index at = 0;
  const auto u = [&](std::size_t i) { return (point[i] - centre[i]) / radius; };
  terms(at++) = 1.0;
  for (std::size_t i = 0; i < n; ++i) {
    terms(at++) = u(i);
    terms(at++) = u(i) * u(i);
    for (std::size_t j = 0; n <= most_with_products && j < i; ++j) terms(at++) = u(i) * u(j);
  }
  return terms;
}

/// Over the lowest, in units of its median; no more than what squares to a number.
std::vector<double> excess_of(std::vector<double> heights) {
  constexpr double most = 1e100;
  const double lowest = *std::min_element(heights.begin(), heights.end());
  for (double& height : heights) height -= lowest;
  auto sorted = heights;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  for (double& height : heights) height = std::min(most, median > 0.0 ? height / median : height);
  return heights;
}

}  // namespace

std::size_t surrogate_terms(std::size_t n) {
  return 1 + 2 * n + (n <= most_with_products ? n * (n - 1) / 2 : 0);
}

std::vector<double> surrogate_minimum(const std::vector<std::vector<double>>& points,
                                      const std::vector<double>& heights,
                                      const std::vector<double>& centre, double radius) {
  const auto size = static_cast<Eigen::Index>(surrogate_terms(centre.size()));
  const auto excess = excess_of(heights);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::VectorXd terms = terms_of(points[i], centre, radius);
    const double weight = 1.0 / ((1.0 + excess[i]) * (1.0 + excess[i]));
    normal += weight * terms * terms.transpose();
    right += weight * excess[i] * terms;
  }
  normal.diagonal().array() += ridge * normal.diagonal().maxCoeff();
  const Eigen::VectorXd coefficients = solve_symmetric(normal, right);

  std::vector<SearchRange> box;
  for (const double c : centre)
    box.push_back({std::max(0.0, c - radius), std::min(1.0, c + radius)});
  // A range whose lower end is above 0 would be searched on a logarithmic scale.
  std::vector<SearchRange> cube(box.size());
  const auto within = [&](const std::vector<double>& u) {
    std::vector<double> point(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) point[i] = std::lerp(box[i].low, box[i].high, u[i]);
    return point;
  };
  const int looks = 200 * static_cast<int>(centre.size());
  return within(covariance_search(cube, looks, [&](const std::vector<double>& u) {
                  return coefficients.dot(terms_of(within(u), centre, radius));
                }).values);
}

}  // namespace gyrostat
