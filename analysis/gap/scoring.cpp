#include "analysis/gap/scoring.hpp"

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace gyrostat::gap {
namespace {

constexpr double degrees = 5.0;
constexpr double least_spread = 0.1;  // of whitened readings, whose baseline spread is about 1
constexpr double forgiven_share = 0.1;

double log_density(double z, double spread) {
  return -0.5 * (degrees + 1.0) * std::log1p(z * z / (spread * spread * degrees)) - std::log(spread);
}

}  // namespace

Scoring::Scoring(const Ensemble& baseline, const Eigen::VectorXd& observed)
    : baseline_(baseline),
      observed_(baseline.whitened(observed)),
      plain_observed_(observed),
      forgiven_(forgiven_share * observed_.cwiseAbs()) {}

LogScore Scoring::of(const Eigen::MatrixXd& replicas) const {
  const Eigen::Index count = replicas.cols();
  const double n = static_cast<double>(count);
  Eigen::MatrixXd white(replicas.rows(), count);
  for (Eigen::Index k = 0; k < count; ++k) white.col(k) = baseline_.whitened(replicas.col(k));
  const Eigen::VectorXd mean = white.rowwise().mean();
  const Eigen::VectorXd variance =
      (white.colwise() - mean).rowwise().squaredNorm() / std::max(1.0, n - 1.0);
  const auto spread_at = [&](Eigen::Index i, double v) {
    return std::sqrt(std::max(v, least_spread * least_spread) * (1.0 + 1.0 / n) +
                     forgiven_[i] * forgiven_[i]);
  };
  LogScore score;
  for (Eigen::Index i = 0; i < mean.size(); ++i)
    score.value += log_density(observed_[i] - mean[i], spread_at(i, variance[i]));
  // A replica that was left out, under the others.
  Eigen::VectorXd own = Eigen::VectorXd::Zero(count);
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index i = 0; i < mean.size(); ++i) {
      const double off = (white(i, k) - mean[i]) * n / (n - 1.0);
      const double others =
          std::max(0.0, (variance[i] * (n - 1.0) - off * off * (n - 1.0) / n) / std::max(1.0, n - 2.0));
      own[k] += log_density(off, spread_at(i, others));
    }
  score.expected = own.mean();
  score.spread = std::sqrt(std::max(1.0, (own.array() - own.mean()).square().sum() / (n - 1.0)));
  return score;
}

Eigen::VectorXd Scoring::spread(const Eigen::MatrixXd& replicas) const {
  const Eigen::VectorXd mean = replicas.rowwise().mean();
  const Eigen::VectorXd variance = (replicas.colwise() - mean).rowwise().squaredNorm() /
                                   std::max(1.0, static_cast<double>(replicas.cols()) - 1.0);
  return (variance + baseline_.spread().cwiseAbs2() +
          (0.05 * (plain_observed_ - baseline_.mean())).cwiseAbs2())
      .cwiseSqrt();
}

std::array<double, 2> bootstrap_closed(const Instrument& instrument, const Ensemble& before,
                                       const Ensemble& after, const Eigen::VectorXd& readings,
                                       std::uint64_t seed) {
  constexpr int draws = 400;
  const NormalStream stream(seed, 0, "bootstrap_closed");
  const Eigen::VectorXd z_before = before.deviations(readings), z_after = after.deviations(readings);
  Eigen::VectorXd drawn_before = z_before, drawn_after = z_after;
  std::vector<double> closed;
  std::uint64_t at = 0;
  for (int draw = 0; draw < draws; ++draw) {
    for (const auto& lens : instrument.lenses())
      for (Eigen::Index k = 0; k < lens.count; ++k) {
        const auto from = lens.first + std::min(lens.count - 1, static_cast<Eigen::Index>(
                                           stream.uniform(at++) * static_cast<double>(lens.count)));
        drawn_before[lens.first + k] = z_before[from];
        drawn_after[lens.first + k] = z_after[from];
      }
    const double from = before.gap_of(drawn_before);
    closed.push_back(from > 0.0 ? 1.0 - after.gap_of(drawn_after) / from : 0.0);
  }
  std::sort(closed.begin(), closed.end());
  return {closed[draws / 40], closed[draws - 1 - draws / 40]};
}

}  // namespace gyrostat::gap
