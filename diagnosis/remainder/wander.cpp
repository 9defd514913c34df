#include <gyrostat/diagnosis/remainder/wander.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/generators/effects/empirical_compass_wander.hpp>
#include <gyrostat/generators/effects/empirical_wander.hpp>

namespace gyrostat::gap {
namespace {

struct Surplus {
  double std, time_s;
};

/// Half the mean squared difference of cluster means of the train part that lie so many clusters
/// apart (a variogram; Cressie, "Statistics for Spatial Data", 1993, 2.4): what a walk makes of it
/// is far less skewed than its covariance.
std::vector<double> variogram(const Conditions& conditions, const std::vector<double>& slow,
                              const std::vector<std::size_t>& lags) {
  std::vector<double> all;
  for (const std::size_t lag : lags) {
    double sum = 0.0, count = 0.0;
    for (const auto& span : conditions.slow_spans(Part::train))
      for (std::size_t i = span.first + lag; i < span.last; ++i) {
        const double apart = slow[i] - slow[i - lag];
        if (is_missing(apart)) continue;
        sum += 0.5 * apart * apart;
        count += 1.0;
      }
    all.push_back(count > 0.0 ? sum / count : 0.0);
  }
  return all;
}

std::optional<Surplus> surplus_of(const Conditions& conditions, const std::vector<double>& own,
                                  const std::vector<std::vector<double>>& replicas) {
  std::size_t longest_span = 0;
  for (const auto& span : conditions.slow_spans(Part::train))
    longest_span = std::max(longest_span, span.size());
  std::vector<std::size_t> lags;
  for (std::size_t lag = 1; lag <= longest_span / 2; lag *= 2) lags.push_back(lag);
  constexpr std::size_t fewest = 4;
  if (lags.size() < fewest) return std::nullopt;
  const auto observed = variogram(conditions, own, lags);
  std::vector<std::vector<double>> replicated;
  for (const auto& replica : replicas) replicated.push_back(variogram(conditions, replica, lags));
  std::vector<double> weights, off;
  for (std::size_t l = 0; l < lags.size(); ++l) {
    std::vector<double> at_lag;
    for (const auto& replica : replicated) at_lag.push_back(replica[l]);
    const Against at(observed[l], at_lag);
    weights.push_back(1.0 / std::max(at.variance, 1e-300));
    off.push_back(at.off);
  }
  std::optional<Surplus> best;
  double least = 1e300;
  const double cluster_s = conditions.slow_interval_s();
  for (double time_s = 2.0 * cluster_s; time_s < static_cast<double>(longest_span) * cluster_s;
       time_s *= 1.3) {
    // By least squares, beside white noise, which is the same at all lags.
    std::vector<double> shape;
    double sum = 0.0, mean = 0.0, squares = 0.0;
    for (std::size_t l = 0; l < lags.size(); ++l) {
      shape.push_back(-std::expm1(-static_cast<double>(lags[l]) * cluster_s / time_s));
      sum += weights[l];
      mean += weights[l] * shape[l];
    }
    mean /= sum;
    for (std::size_t l = 0; l < lags.size(); ++l)
      squares += weights[l] * (shape[l] - mean) * (shape[l] - mean);
    const auto variance_in = [&](const std::vector<double>& of) {
      double products = 0.0;
      for (std::size_t l = 0; l < lags.size(); ++l)
        products += weights[l] * (shape[l] - mean) * of[l];
      return products / squares;
    };
    const double found = variance_in(off);
    double white = 0.0, left = 0.0;
    for (std::size_t l = 0; l < lags.size(); ++l)
      white += weights[l] * (off[l] - found * shape[l]) / sum;
    for (std::size_t l = 0; l < lags.size(); ++l)
      left += weights[l] * std::pow(off[l] - found * shape[l] - white, 2);
    if (left >= least) continue;
    least = left;
    best.reset();
    std::vector<double> by_chance;
    for (const auto& replica : replicated) by_chance.push_back(variance_in(replica));
    const Against variance(variance_in(observed), by_chance);
    const double farthest = *std::max_element(by_chance.begin(), by_chance.end()) -
                            (variance_in(observed) - variance.off);
    if (variance.off > 2.0 * farthest && 0.5 * variance.chi_squared() - 2.0 > clear_gain)
      best = Surplus{std::sqrt(variance.off), time_s};
  }
  return best;
}

}  // namespace

std::optional<Nameless> rate_wander_part(const Conditions& conditions,
                                         const Replicated& replicated) {
  std::vector<std::vector<double>> replicas;
  for (const auto& replica : replicated.replicas) replicas.push_back(replica.slow_dps);
  const auto found = surplus_of(conditions, replicated.recording.slow_dps, replicas);
  if (!found) return std::nullopt;
  return Nameless{effects::EmpiricalWander{.std_dps = found->std, .time_s = found->time_s},
                  fmt::format("a nameless wander of the rate of {:.2g} dps over {:.2g} s",
                              found->std, found->time_s)};
}

std::optional<Nameless> compass_wander_part(const Conditions& conditions,
                                            const Replicated& replicated) {
  if (replicated.recording.heading_deg.empty()) return std::nullopt;
  std::vector<std::vector<double>> replicas;
  for (const auto& replica : replicated.replicas)
    replicas.push_back(conditions.slow_means(replica.heading_deg));
  const auto found =
      surplus_of(conditions, conditions.slow_means(replicated.recording.heading_deg), replicas);
  if (!found) return std::nullopt;
  return Nameless{effects::EmpiricalCompassWander{.std_deg = found->std, .time_s = found->time_s},
                  fmt::format("a further wander of the compass of {:.2g} deg over {:.2g} s",
                              found->std, found->time_s)};
}

}  // namespace gyrostat::gap
