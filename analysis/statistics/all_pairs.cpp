#include <gyrostat/analysis/statistics/all_pairs.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t draws = 20'000;
constexpr std::size_t draws_at_once = 32;  ///< of which `draws` is a multiple
constexpr std::size_t fewest_beyond = 50;  ///< draws, for a tail to be told by them
constexpr double rounding = 1e-12;
constexpr double too_alike = 1e-6;  ///< spreads beside the largest, for correlations to be told

}  // namespace

AllPairs::AllPairs(std::size_t methods, double looks)
    : methods_(methods),
      looks_(looks),
      comparisons_(looks * static_cast<double>(methods * (methods - 1) / 2)),
      pairs_(methods * (methods - 1) / 2) {}

void AllPairs::add(std::span<const double> values) {
  auto* pair = pairs_.data();
  for (std::size_t a = 1; a < methods_; ++a)
    for (std::size_t b = 0; b < a; ++b, ++pair) {
      const double d = values[a] - values[b];
      if (std::isnan(d)) continue;
      if (passes_ == 0) {
        pair->sum += d;
        ++pair->count;
      } else {
        const double from_mean = d - pair->mean;
        pair->squares += from_mean * from_mean;
        pair->cubes += from_mean * from_mean * from_mean;
      }
    }
}

bool AllPairs::another_pass() {
  if (++passes_ == 1) {
    for (auto& pair : pairs_) pair.mean = pair.sum / static_cast<double>(pair.count);
    return true;
  }
  const auto beyond = static_cast<std::size_t>(0.05 / looks_ * static_cast<double>(draws));
  auto most = largest();
  if (most.empty() || beyond < fewest_beyond) return false;  // Bonferroni's stand
  std::nth_element(most.begin(), most.end() - static_cast<std::ptrdiff_t>(beyond), most.end());
  double trials = 0.0, alike = 0.0;
  const double widest = widest_error();
  for (const auto& pair : pairs_) {
    trials = std::max(trials, static_cast<double>(pair.count));
    const double error = pair.error();
    alike += error <= too_alike * widest && error > rounding * (widest + std::abs(pair.mean));
  }
  const double tail = student_t_upper_tail(most[draws - beyond], trials - 1.0);
  comparisons_ = std::clamp(0.025 / tail + looks_ * alike, looks_, comparisons_);
  return false;
}

double AllPairs::widest_error() const {
  double widest = 0.0;
  for (const auto& pair : pairs_) widest = std::fmax(widest, pair.error());
  return widest;
}

std::vector<double> AllPairs::largest() const {
  const auto methods = static_cast<Eigen::Index>(methods_);
  Eigen::ArrayXXd precision = Eigen::ArrayXXd::Zero(methods, methods);  // (b, a); 0: not told
  std::size_t told = 0;
  double trials = 0.0;
  const double widest = widest_error();
  for (std::size_t a = 1; a < methods_; ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (const double error = pair(a, b).error(); error > too_alike * widest) {
        precision(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(a)) = 1.0 / error;
        ++told;
        trials = std::max(trials, static_cast<double>(pair(a, b).count));
      }
  if (told < 2) return {};

  // Covariances of the methods' differences from the first, from the variances of all differences.
  const auto square = [&](std::size_t a, std::size_t b) {
    const double error = a == b ? 0.0 : pair(std::max(a, b), std::min(a, b)).error();
    return std::isnan(error) ? 0.0 : error * error;
  };
  const auto others = static_cast<Eigen::Index>(methods_ - 1);
  Eigen::MatrixXd covariance(others, others);
  for (std::size_t a = 1; a < methods_; ++a)
    for (std::size_t b = 1; b < methods_; ++b)
      covariance(static_cast<Eigen::Index>(a - 1), static_cast<Eigen::Index>(b - 1)) =
          0.5 * (square(a, 0) + square(b, 0) - square(a, b));
  const Eigen::MatrixXd root = semidefinite_root(covariance);

  std::vector<double> most;
  const NormalStream stream(0, 0, "all pairs");
  const double freedom = trials - 1.0;
  std::vector<double> normals(methods_);
  // Of several draws at once, as precisions fill a cache.
  Eigen::MatrixXd at = Eigen::MatrixXd::Zero(methods, draws_at_once);
  std::array<double, draws_at_once> spread{}, largest{};
  for (std::size_t first = 0; first < draws; first += draws_at_once) {
    for (std::size_t k = 0; k < draws_at_once; ++k) {
      stream.fill((first + k) * methods_, normals);
      at.col(static_cast<Eigen::Index>(k)).tail(others) =
          root * Eigen::Map<const Eigen::VectorXd>(normals.data(), others);
      // Chi-squared over its degrees of freedom (Wilson and Hilferty, PNAS 17, 1931).
      const double cube_root =
          1.0 - 2.0 / (9.0 * freedom) + normals.back() * std::sqrt(2.0 / (9.0 * freedom));
      spread[k] = std::sqrt(std::max(1e-6, cube_root * cube_root * cube_root));
    }
    largest.fill(0.0);
    for (Eigen::Index a = 1; a < methods; ++a)
      for (std::size_t k = 0; k < draws_at_once; ++k) {
        const auto values = at.col(static_cast<Eigen::Index>(k)).array();
        const auto t = (values.head(a) - values(a)).abs() * precision.col(a).head(a);
        largest[k] = std::max(largest[k], t.maxCoeff());
      }
    for (std::size_t k = 0; k < draws_at_once; ++k) most.push_back(largest[k] / spread[k]);
  }
  return most;
}

PairedDifference AllPairs::difference(std::size_t a, std::size_t b) const {
  if (a < b) {
    auto turned = difference(b, a);
    turned.mean = -turned.mean;
    std::tie(turned.low, turned.high) = std::pair(-turned.high, -turned.low);
    return turned;
  }
  const auto& p = pair(a, b);
  if (passes_ < 2) return {.count = p.count};
  return paired_difference(p.differences(), comparisons_);
}

}  // namespace gyrostat
