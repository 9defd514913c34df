#include <gyrostat/diagnosis/gap/ensemble.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::gap {
namespace {

constexpr double largest_deviation = 1e3;  // more says no more
constexpr double shrinkage = 0.25;

double mean_square(const Eigen::VectorXd& z, const LensView& lens) {
  return (z.segment(lens.first, lens.count).squaredNorm() + 1e-6) / static_cast<double>(lens.count);
}

double largest(const Eigen::VectorXd& z, const LensView& lens) {
  return z.segment(lens.first, lens.count).cwiseAbs().maxCoeff();
}

struct Moments {
  double mean, variance;
};
/// Of all values but the one at `left_out`.
Moments moments(const std::vector<double>& values, std::size_t left_out) {
  double mean = 0.0, square = 0.0, count = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (k != left_out) {
      mean += values[k];
      count += 1.0;
    }
  mean /= count;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (k != left_out) square += (values[k] - mean) * (values[k] - mean);
  return {mean, std::max(square / (count - 1.0), 1e-12)};
}

/// Of chi-squared whose logarithm has this variance: trigamma(d / 2), by its first two terms.
double degrees_of(double variance_of_log) {
  return (1.0 + std::sqrt(1.0 + 2.0 * variance_of_log)) / variance_of_log;
}

/// That log(chi-squared / degrees) lies so far below its mean or more.
double lower_tail_of_log(double below, double degrees) {
  return chi_squared_cdf(2.0 * std::exp(digamma(0.5 * degrees) - below), degrees);
}

}  // namespace

Ensemble::Ensemble(const Instrument& instrument, const Eigen::MatrixXd& replicas,
                   const Eigen::MatrixXd& jacobian)
    : lenses_(instrument.lenses()) {
  const Eigen::Index count = replicas.cols();
  mean_ = replicas.rowwise().mean();
  Eigen::MatrixXd off = replicas.colwise() - mean_;
  Eigen::VectorXd least = Eigen::VectorXd::Constant(mean_.size(), 1e-12);
  for (const auto& lens : lenses_)
    least.segment(lens.first, lens.count).array() += lens.least_spread;
  const auto spread_of = [&](const Eigen::MatrixXd& d) -> Eigen::VectorXd {
    return (d.rowwise().squaredNorm() / static_cast<double>(count - 1)).cwiseSqrt().cwiseMax(least);
  };
  spread_ = spread_of(off);
  credited_ = (1.0 - (off.rowwise().squaredNorm() / static_cast<double>(count - 1))
                         .cwiseQuotient(spread_.cwiseAbs2())
                         .array())
                  .max(0.0)
                  .sqrt();
  lacking_ = credited_.cwiseProduct(spread_);
  Eigen::MatrixXd drawn(off.rows(), count);
  for (Eigen::Index k = 0; k < count; ++k) drawn.col(k) = made_up(static_cast<std::uint64_t>(k));
  mean_made_up_ = drawn.rowwise().mean();
  off += drawn.colwise() - mean_made_up_;
  if (jacobian.cols() > 0) {
    refit_left_ = jacobian;
    const Eigen::MatrixXd weighted = spread_.cwiseAbs2().cwiseInverse().asDiagonal() * jacobian;
    Eigen::MatrixXd information = jacobian.transpose() * weighted;
    information.diagonal().array() += 1.0;  // by no more than an e-fold, where nothing shows it
    refit_right_ = solve_symmetric(information, Eigen::MatrixXd(weighted.transpose()));
    off -= refit_left_ * (refit_right_ * off);
    spread_ = spread_of(off);
  }

  // Each replica against all the others, as the recording is against all.
  Eigen::MatrixXd z(off.rows(), count);
  const double n = static_cast<double>(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::VectorXd d = off.col(k) * (n / (n - 1.0));
    const Eigen::VectorXd others =
        ((spread_.cwiseAbs2() * (n - 1.0) - off.col(k).cwiseAbs2() * (n / (n - 1.0))) / (n - 2.0))
            .cwiseMax(least.cwiseAbs2())
            .cwiseSqrt();
    z.col(k) = d.cwiseQuotient(others).cwiseMin(largest_deviation).cwiseMax(-largest_deviation);
  }
  std::vector<std::vector<double>> squares(lenses_.size()), peaks(lenses_.size());
  for (std::size_t l = 0; l < lenses_.size(); ++l) {
    const auto& lens = lenses_[l];
    for (Eigen::Index k = 0; k < count; ++k) {
      squares[l].push_back(std::log(mean_square(z.col(k), lens)));
      peaks[l].push_back(largest(z.col(k), lens));
    }
    const Eigen::MatrixXd scaled =
        spread_.segment(lens.first, lens.count).cwiseInverse().asDiagonal() *
        off.middleRows(lens.first, lens.count);
    Eigen::MatrixXd correlation = (1.0 - shrinkage) / (n - 1.0) * scaled * scaled.transpose();
    correlation.diagonal().array() += shrinkage;
    roots_.push_back(cholesky_root(correlation));
  }
  const auto tails_without = [&](Eigen::Index replica) {
    std::vector<Tail> tails;
    for (std::size_t l = 0; l < lenses_.size(); ++l) {
      const auto square = moments(squares[l], static_cast<std::size_t>(replica));
      const auto peak = moments(peaks[l], static_cast<std::size_t>(replica));
      const double width = std::sqrt(6.0 * peak.variance) / std::numbers::pi;
      const double variance = square.variance + 0.01;
      tails.push_back({square.mean, std::sqrt(variance),
                       std::min(degrees_of(variance), static_cast<double>(lenses_[l].count)),
                       peak.mean - std::numbers::egamma * width, width});
    }
    return tails;
  };
  for (Eigen::Index k = 0; k < count; ++k) {
    replica_least_.push_back(least_probability(z.col(k), tails_without(k)));
    replica_largest_.push_back(z.col(k).cwiseAbs().maxCoeff());
  }
  tails_ = tails_without(count);
  std::sort(replica_least_.begin(), replica_least_.end());
  std::sort(replica_largest_.begin(), replica_largest_.end());
}

/// Where all replicas read the same, a recording that differs by far less than what is credited
/// would otherwise be infinitely far off. What they lack is drawn, for each of them and for a
/// recording alike, so that one of their own is exchangeable with them; from streams that the
/// replicas seed, so that it is another draw for other replicas.
Eigen::VectorXd Ensemble::made_up(std::uint64_t column) const {
  Eigen::VectorXd off = Eigen::VectorXd::Zero(mean_.size());
  for (Eigen::Index i = 0; i < off.size(); ++i)
    if (lacking_[i] > 0.0)
      off[i] = lacking_[i] * NormalStream(std::bit_cast<std::uint64_t>(mean_.sum()),
                                          static_cast<std::uint32_t>(i), "ensemble/credited")
                                 .normal(column);
  return off;
}

Eigen::VectorXd Ensemble::deviations(const Eigen::VectorXd& readings) const {
  Eigen::VectorXd off = readings - mean_;
  if (refit_left_.cols() > 0) off -= refit_left_ * (refit_right_ * off);
  return off.cwiseQuotient(spread_).cwiseMin(largest_deviation).cwiseMax(-largest_deviation);
}

double Ensemble::log_mean_square(const Eigen::VectorXd& z, const LensView& lens) const {
  const double credited = credited_.segment(lens.first, lens.count).squaredNorm();
  return std::log(mean_square(z, lens) + credited / static_cast<double>(lens.count));
}

Eigen::VectorXd Ensemble::lens_deviations(const Eigen::VectorXd& z) const {
  Eigen::VectorXd t(static_cast<Eigen::Index>(lenses_.size()));
  for (std::size_t l = 0; l < lenses_.size(); ++l)
    t[static_cast<Eigen::Index>(l)] =
        (log_mean_square(z, lenses_[l]) - tails_[l].centre) / tails_[l].spread;
  return t;
}

double Ensemble::least_probability(const Eigen::VectorXd& z, const std::vector<Tail>& tails,
                                   std::string_view without) const {
  double least = 1.0;
  for (std::size_t l = 0; l < lenses_.size(); ++l) {
    if (lenses_[l].channel == without) continue;
    const auto& tail = tails[l];
    const double off = std::log(mean_square(z, lenses_[l])) - tail.centre;
    const double beyond =
        off > 0.0 ? normal_upper_tail(off / tail.spread) : lower_tail_of_log(-off, tail.degrees);
    least = std::min(least, 2.0 * beyond);
    least = std::min(least,
                     -std::expm1(-std::exp((tail.location - largest(z, lenses_[l])) / tail.width)));
  }
  return least;
}

double Ensemble::p_value_without(std::string_view channel, const Eigen::VectorXd& readings) const {
  const double least = least_probability(
      deviations(readings + made_up(replica_least_.size()) - mean_made_up_), tails_, channel);
  const auto below = std::upper_bound(replica_least_.begin(), replica_least_.end(), least) -
                     replica_least_.begin();
  const double n = static_cast<double>(replica_least_.size());
  if (below > 0) return (static_cast<double>(below) + 1.0) / (n + 1.0);
  // Continues the replicas' own smallest in proportion.
  return std::min(1.0, least / std::max(replica_least_.front(), 1e-300)) / (n + 1.0);
}

std::vector<Departure> Ensemble::departures(const Eigen::VectorXd& readings, double level) const {
  const Eigen::VectorXd z = deviations(readings);
  std::vector<Departure> found;
  const double n = static_cast<double>(replica_largest_.size());
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    const double size = std::abs(z[i]);
    const auto beyond = replica_largest_.end() -
                        std::lower_bound(replica_largest_.begin(), replica_largest_.end(), size);
    double p = (static_cast<double>(beyond) + 1.0) / (n + 1.0);
    if (beyond == 0)
      p = std::max(1e-300,
                   std::min(p, 2.0 * static_cast<double>(z.size()) * normal_upper_tail(size)));
    if (p <= level) found.push_back({i, z[i], p});
  }
  return found;
}

Eigen::VectorXd Ensemble::whitened(const Eigen::VectorXd& readings) const {
  Eigen::VectorXd z = deviations(readings);
  for (std::size_t l = 0; l < lenses_.size(); ++l) {
    auto segment = z.segment(lenses_[l].first, lenses_[l].count);
    segment = roots_[l].triangularView<Eigen::Lower>().solve(segment).eval();
  }
  return z;
}

}  // namespace gyrostat::gap
