#include <gyrostat/analysis/search/covariance_search.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double first_deviation = 0.3;
constexpr double least_deviation = 1e-4;

/// Into [0, 1], by reflection at its ends.
double folded(double x) {
  const double distance = std::fabs(std::remainder(x, 2.0));
  return std::min(distance, 1.0);
}

/// The strategy's constants for n dimensions and a population (tutorial, table 1).
struct Constants {
  Constants(int n, int population)
      : weights(population / 2),
        expected_norm(std::sqrt(n) * (1 - 0.25 / n + 1.0 / (21.0 * n * n))) {
    for (int i = 0; i < weights.size(); ++i)
      weights(i) = std::log((population + 1) / 2.0) - std::log(i + 1.0);
    weights /= weights.sum();
    const double mu = 1.0 / weights.squaredNorm();
    effective = mu;
    step_rate = (mu + 2) / (n + mu + 5);
    step_damping = 1 + 2 * std::max(0.0, std::sqrt((mu - 1) / (n + 1)) - 1) + step_rate;
    path_rate = (4 + mu / n) / (n + 4 + 2 * mu / n);
    rank_one = 2 / ((n + 1.3) * (n + 1.3) + mu);
    rank_mu = std::min(1 - rank_one, 2 * (mu - 2 + 1 / mu) / ((n + 2.0) * (n + 2.0) + mu));
  }

  VectorXd weights;
  double expected_norm;  ///< E |N(0, I)|
  double effective, step_rate, step_damping, path_rate, rank_one, rank_mu;
};

/// One run of the strategy in the unit cube, from a mean on.
class Evolution {
 public:
  Evolution(VectorXd mean, int population, NormalStream noise)
      : n_(static_cast<int>(mean.size())),
        c_(n_, population),
        noise_(noise),
        mean_(std::move(mean)),
        covariance_(MatrixXd::Identity(n_, n_)),
        axes_(covariance_),
        lengths_(VectorXd::Ones(n_)),
        step_path_(VectorXd::Zero(n_)),
        path_(VectorXd::Zero(n_)),
        moves_(n_, population) {}

  bool has_converged() const { return deviation_ * lengths_.maxCoeff() < least_deviation; }

  /// The next candidates, one a column, reflected into the cube.
  MatrixXd candidates() {
    for (int k = 0; k < moves_.cols(); ++k)
      for (int d = 0; d < n_; ++d) moves_(d, k) = noise_.normal(drawn_++);
    moves_ = axes_ * lengths_.asDiagonal() * moves_;
    return ((deviation_ * moves_).colwise() + mean_).unaryExpr(&folded);
  }

  /// Moves and reshapes the distribution by the candidates' objectives.
  void learn(const std::vector<double>& objectives) {
    ++generation_;
    std::vector<int> order(objectives.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return objectives[static_cast<std::size_t>(a)] < objectives[static_cast<std::size_t>(b)];
    });
    VectorXd move = VectorXd::Zero(n_);
    MatrixXd spread = MatrixXd::Zero(n_, n_);
    for (int i = 0; i < c_.weights.size(); ++i) {
      const auto best = moves_.col(order[static_cast<std::size_t>(i)]);
      move += c_.weights(i) * best;
      spread += c_.weights(i) * best * best.transpose();
    }
    mean_ = (mean_ + deviation_ * move).unaryExpr(&folded);

    const VectorXd whitened =
        axes_ * lengths_.cwiseInverse().asDiagonal() * (axes_.transpose() * move);
    step_path_ = (1 - c_.step_rate) * step_path_ +
                 std::sqrt(c_.step_rate * (2 - c_.step_rate) * c_.effective) * whitened;
    const double norm = step_path_.norm();
    const double settled = std::sqrt(1 - std::pow(1 - c_.step_rate, 2 * generation_));
    const bool is_short = norm / settled < (1.4 + 2.0 / (n_ + 1)) * c_.expected_norm;
    path_ *= 1 - c_.path_rate;
    if (is_short) path_ += std::sqrt(c_.path_rate * (2 - c_.path_rate) * c_.effective) * move;
    const double lost = is_short ? 0.0 : c_.path_rate * (2 - c_.path_rate);
    covariance_ = (1 - c_.rank_one * (1 - lost) - c_.rank_mu) * covariance_ +
                  c_.rank_one * path_ * path_.transpose() + c_.rank_mu * spread;
    deviation_ *= std::exp(c_.step_rate / c_.step_damping * (norm / c_.expected_norm - 1));
    deviation_ = std::min(deviation_, 1.0);

    const auto eigen = symmetric_eigen(covariance_);
    axes_ = eigen.vectors;
    lengths_ = eigen.values.cwiseMax(1e-20).cwiseSqrt();
  }

 private:
  int n_;
  Constants c_;
  NormalStream noise_;
  std::uint64_t drawn_ = 0;
  VectorXd mean_;
  double deviation_ = first_deviation;
  MatrixXd covariance_, axes_;
  VectorXd lengths_;  ///< along the axes
  VectorXd step_path_, path_;
  MatrixXd moves_;
  int generation_ = 0;
};

}  // namespace

SearchResult covariance_search(const std::vector<SearchRange>& ranges, int evaluations,
                               const std::function<double(const std::vector<double>&)>& objective) {
  if (ranges.empty()) return box_search(ranges, evaluations, objective);
  const auto n = static_cast<int>(ranges.size());
  SearchResult result;
  int population = 4 + static_cast<int>(3 * std::log(n));
  VectorXd start = VectorXd::Constant(n, 0.5);
  std::vector<double> values(ranges.size()), objectives;
  for (std::uint32_t run = 0; result.evaluations < evaluations; ++run, population *= 2) {
    const NormalStream begin(0, run, "covariance_search/start");
    if (run > 0)
      for (int d = 0; d < n; ++d) start(d) = begin.uniform(static_cast<std::uint64_t>(d));
    Evolution evolution(start, population, NormalStream(0, run, "covariance_search"));
    while (result.evaluations < evaluations && !evolution.has_converged()) {
      const MatrixXd candidates = evolution.candidates();
      objectives.clear();
      for (int k = 0; k < population && result.evaluations < evaluations; ++k) {
        for (int d = 0; d < n; ++d) {
          const auto i = static_cast<std::size_t>(d);
          values[i] = ranges[i].at(candidates(d, k));
        }
        double found = objective(values);
        ++result.evaluations;
        if (std::isnan(found)) found = std::numeric_limits<double>::infinity();
        objectives.push_back(found);
        if (!result.values.empty() && !(found < result.objective)) continue;
        result.values = values;
        result.objective = found;
      }
      if (static_cast<int>(objectives.size()) == population) evolution.learn(objectives);
    }
  }
  return result;
}

}  // namespace gyrostat
