// The local level against dense matrices, and the random walk that it finds.

#include <gyrostat/diagnosis/gap/local_level.hpp>

#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gmock/gmock.h>

#include <gyrostat/core/random.hpp>

namespace gyrostat::gap::local_level_test {
namespace {

/// A stretch of points with a hole in it.
std::vector<std::size_t> points_with_hole(std::size_t count) {
  std::vector<std::size_t> points(count);
  std::iota(points.begin(), points.end(), std::size_t{3});
  for (std::size_t k = count / 2; k < count; ++k) points[k] += 17;
  return points;
}

Eigen::VectorXd walk_in_noise(const std::vector<std::size_t>& points, double ratio,
                              std::uint32_t trial) {
  std::vector<double> steps(points.back() + 1), white(points.size());
  NormalStream(3, trial, "walk").fill(0, steps);
  NormalStream(3, trial, "white").fill(0, white);
  std::partial_sum(steps.begin(), steps.end(), steps.begin());
  Eigen::VectorXd values(static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = 5.0 + std::sqrt(ratio) * steps[points[k]] + white[k];
  return values;
}

/// -2 log of the restricted likelihood (Harville, Biometrika 61, 1974), white noise concentrated
/// out.
double dense_deviance(const std::vector<std::size_t>& points, const Eigen::MatrixXd& regressors,
                      const Eigen::VectorXd& y, double ratio) {
  const Eigen::Index n = y.size();
  Eigen::MatrixXd V = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      V(i, j) += ratio * static_cast<double>(std::min(points[static_cast<std::size_t>(i)],
                                                      points[static_cast<std::size_t>(j)]) -
                                             points[0]);
  Eigen::MatrixXd X(n, regressors.cols() + 1);
  X << Eigen::VectorXd::Ones(n), regressors;
  const Eigen::MatrixXd W = V.inverse();
  const Eigen::MatrixXd information = X.transpose() * W * X;
  const Eigen::VectorXd rest = y - X * information.inverse() * (X.transpose() * (W * y));
  const double freedom = static_cast<double>(n - X.cols());
  return std::log(V.determinant()) + std::log(information.determinant()) +
         freedom * std::log(rest.dot(W * rest));
}

TEST(LocalLevel, ItsLikelihoodIsThatOfDenseMatrices) {
  const auto points = points_with_hole(40);
  const auto y = walk_in_noise(points, 0.05, 0);
  Eigen::MatrixXd regressors(40, 2);
  for (int k = 0; k < 40; ++k) regressors.row(k) << std::sin(0.3 * k), 0.1 * k;
  const RatioLikelihood likelihood(points, regressors, y);
  // At ratios of its own grid, where nothing is interpolated.
  const auto at = [](int k) { return 1e-9 * std::exp(0.5 * k); };
  const double between =
      dense_deviance(points, regressors, y, at(30)) - dense_deviance(points, regressors, y, at(44));
  EXPECT_NEAR(likelihood.deviance(at(30)) - likelihood.deviance(at(44)), between, 1e-6);
  EXPECT_DOUBLE_EQ(likelihood.deviance(likelihood.most_likely()), 0.0);
}

// 400 recordings of 300 points: ln(ratio) has a spread of about 0.4 each and the grid rounds it by
// 0.5 / sqrt(12), so their mean has a standard error of 0.02; 0.1 is five of them.
TEST(LocalLevel, FindsTheRatioOfARandomWalk) {
  const auto points = points_with_hole(300);
  double sum = 0.0;
  for (std::uint32_t trial = 0; trial < 400; ++trial)
    sum +=
        std::log(RatioLikelihood(points, Eigen::MatrixXd(300, 0), walk_in_noise(points, 0.1, trial))
                     .most_likely());
  EXPECT_NEAR(sum / 400.0, std::log(0.1), 0.1);
}

// The mean square of 400 x 299 innovations has a standard error of 0.0041, their first
// autocorrelation one of 0.0029: four of each are passed once in 16,000.
TEST(LocalLevel, InnovationsOfATrueModelAreWhite) {
  const auto points = points_with_hole(300);
  const LocalLevel level(points, 0.1);
  double square = 0.0, lagged = 0.0;
  for (std::uint32_t trial = 0; trial < 400; ++trial) {
    const auto v = level.innovations(walk_in_noise(points, 0.1, trial));
    square += v.squaredNorm();
    lagged += v.head(298).dot(v.tail(298));
  }
  EXPECT_NEAR(square / (400.0 * 299.0), 1.0, 4.0 * 0.0041);
  EXPECT_NEAR(lagged / (400.0 * 299.0), 0.0, 4.0 * 0.0029);
}

}  // namespace
}  // namespace gyrostat::gap::local_level_test
