#include <gyrostat/diagnosis/gap/scoring.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/random.hpp>

namespace gyrostat::gap {
namespace {

constexpr double degrees = 5.0;
constexpr double least_spread = 0.1;    // of whitened readings, whose baseline spread is about 1
constexpr double shared_degrees = 6.0;  // that a variance borrows from the others of its lens
constexpr double forgiven_share = 0.1;

double log_density(double z, double spread) {
  return -0.5 * (degrees + 1.0) * std::log1p(z * z / (spread * spread * degrees)) -
         std::log(spread);
}

double squared_deviation(double nats) {
  return degrees * std::expm1(2.0 * std::max(0.0, nats) / (degrees + 1.0));
}

double mean_square_shortfall(const Eigen::VectorXd& each, const Eigen::VectorXd& expected) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < each.size(); ++i) sum += squared_deviation(expected[i] - each[i]);
  return sum / static_cast<double>(each.size());
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
  Eigen::VectorXd of_lens(mean.size());
  for (const auto& lens : baseline_.lenses())
    of_lens.segment(lens.first, lens.count)
        .setConstant(variance.segment(lens.first, lens.count).mean());
  const auto spread_at = [&](Eigen::Index i, double v) {
    const double shared =
        ((n - 1.0) * v + shared_degrees * of_lens[i]) / (n - 1.0 + shared_degrees);
    const double least = std::max(least_spread, baseline_.credited()[i]);
    return std::sqrt(std::max(shared, least * least) * (1.0 + 1.0 / n) +
                     forgiven_[i] * forgiven_[i]);
  };
  LogScore score;
  score.each.resize(mean.size());
  score.expected_each = Eigen::VectorXd::Zero(mean.size());
  for (Eigen::Index i = 0; i < mean.size(); ++i)
    score.each[i] = log_density(observed_[i] - mean[i], spread_at(i, variance[i]));
  score.value = score.each.sum();
  // A replica that was left out, under the others.
  Eigen::VectorXd own = Eigen::VectorXd::Zero(count);
  Eigen::MatrixXd own_each(mean.size(), count);
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index i = 0; i < mean.size(); ++i) {
      const double off = (white(i, k) - mean[i]) * n / (n - 1.0);
      const double others = std::max(
          0.0, (variance[i] * (n - 1.0) - off * off * (n - 1.0) / n) / std::max(1.0, n - 2.0));
      const double density = log_density(off, spread_at(i, others));
      own[k] += density;
      own_each(i, k) = density;
      score.expected_each[i] += density / n;
    }
  Eigen::VectorXd shortfalls(count);
  for (Eigen::Index k = 0; k < count; ++k)
    shortfalls[k] = mean_square_shortfall(own_each.col(k), score.expected_each);
  std::sort(shortfalls.begin(), shortfalls.end());
  score.typical_shortfall = shortfalls[std::min(count - 1, count * 9 / 10)];
  score.rare_shortfall = shortfalls[std::min(count - 1, count * 39 / 40)];
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

double gap_of(const LogScore& score, const LogScore& truth) {
  return std::sqrt(std::max(
      0.0, mean_square_shortfall(score.each, truth.expected_each) - truth.typical_shortfall));
}

bool may_be_closed(const LogScore& score, const LogScore& truth) {
  return mean_square_shortfall(score.each, truth.expected_each) <= truth.rare_shortfall;
}

std::array<double, 2> bootstrap_closed(const Instrument& instrument, const LogScore& before,
                                       const LogScore& after, const LogScore& truth,
                                       std::uint64_t seed) {
  constexpr int draws = 400;
  const NormalStream stream(seed, 0, "bootstrap_closed");
  LogScore b = before, a = after, t = truth;
  std::vector<double> closed;
  std::uint64_t at = 0;
  for (int draw = 0; draw < draws; ++draw) {
    for (const auto& lens : instrument.lenses())
      for (Eigen::Index k = 0; k < lens.count; ++k) {
        const auto from =
            lens.first +
            std::min(lens.count - 1, static_cast<Eigen::Index>(stream.uniform(at++) *
                                                               static_cast<double>(lens.count)));
        b.each[lens.first + k] = before.each[from];
        a.each[lens.first + k] = after.each[from];
        t.expected_each[lens.first + k] = truth.expected_each[from];
      }
    const double from = gap_of(b, t);
    closed.push_back(from > 0.0 ? 1.0 - gap_of(a, t) / from : 0.0);
  }
  std::sort(closed.begin(), closed.end());
  return {closed[draws / 40], closed[draws - 1 - draws / 40]};
}

}  // namespace gyrostat::gap
