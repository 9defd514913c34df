#include <gyrostat/diagnosis/likelihood/rate_likelihood.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace gyrostat::gap {
namespace {

/// A decaying error with a memory of less than so many clusters is noise to their means.
constexpr double shortest_memory = 0.5;

/// Variance of the mean of a decaying error over u memories, and the covariance of two neighbouring
/// means, both over the variance (Papoulis, "Probability, Random Variables and Stochastic
/// Processes", 3rd ed., 10-1).
struct MeanOf {
  double variance, neighbours;
};
MeanOf mean_over(double u) {
  if (u < 1e-4) return {1.0 - u / 3.0, 1.0 - u};
  const double lost = -std::expm1(-u);
  return {2.0 * (u - lost) / (u * u), lost * lost / (u * u)};
}

/// A law as what is white to cluster means, and what they remember.
struct Bands {
  NoiseLaw fast, slow;
};

Bands bands_of(const NoiseLaw& law, double cluster_s) {
  Bands bands{.fast = law, .slow = {.interval_s = law.interval_s, .duration_s = law.duration_s}};
  bands.slow.walk = std::exchange(bands.fast.walk, 0.0);
  bands.slow.jumps = std::exchange(bands.fast.jumps, std::nullopt);
  bands.fast.decaying.clear();
  NoiseLaw* band = nullptr;
  for (const auto& d : law.decaying) {
    if (band == nullptr || d.variance >= 0.0)
      band = d.memory_s < shortest_memory * cluster_s ? &bands.fast : &bands.slow;
    band->decaying.push_back(d);
  }
  return bands;
}

/// What noise that is fast shares with the next cluster's, as a decaying error with the covariances
/// of its mean with the next two; lines are white to means.
std::optional<SlowLaw::Part> shared_by_means(const RateGrid& grid, const NoiseLaw& fast,
                                             const std::vector<double>& gain_of_white,
                                             double cluster_s) {
  auto [next, after] = grid.covariances_of_means(gain_of_white);
  const double of_unit_noise = 2.0 * fast.interval_s * fast.white;
  next *= of_unit_noise;
  after *= of_unit_noise;
  for (const auto& d : fast.decaying) {
    const double u = cluster_s / d.memory_s;
    const double shared = d.variance * mean_over(u).neighbours;
    next += shared;
    after += shared * std::exp(-u);
  }
  constexpr double least_decay = 0.05, most_decay = 0.99;
  if (!(next > 0.0)) return std::nullopt;
  const double decay = std::clamp(after / next, least_decay, most_decay);
  return SlowLaw::Part{next / decay, decay};
}

SlowLaw slow_law_of(const ReducedRate& reduced, const Bands& bands,
                    const std::vector<double>& fast_density,
                    const std::vector<double>& gain_of_white, double interval_s) {
  const auto& remembered = bands.slow;
  SlowLaw slow{.white = 0.0,
               .walk = remembered.walk * interval_s,
               .parts = {},
               .jumps = remembered.jumps,
               .interval_s = interval_s};
  slow.white = reduced.grid().variance_of_a_mean(fast_density) * reduced.noise_of_means();
  // Where what they share is less than that, means are white.
  constexpr double least_shared = 0.02;
  const auto shared = shared_by_means(reduced.grid(), bands.fast, gain_of_white, interval_s);
  const bool is_shared = shared && shared->variance * shared->decay > least_shared * slow.white;
  // The mean of a walk over its cluster has a sixth of a step's variance less than its end.
  slow.white -= slow.walk / 6.0;
  double at_the_fastest = 0.25 * slow.walk, size = at_the_fastest;
  const auto add = [&](const SlowLaw::Part& part) {
    slow.white -= part.variance;
    const double fastest = part.variance * (1.0 - part.decay) / (1.0 + part.decay);
    at_the_fastest += fastest;
    size += std::abs(fastest);
    slow.parts.push_back(part);
    return fastest;
  };
  for (const auto& d : remembered.decaying) {
    // Means over u memories have covariances that fall by exp(-u) from lag to lag, from the first
    // on; that at lag 0 is a little less than where they come from. The white noise of the means
    // takes the difference up.
    const double u = interval_s / d.memory_s;
    const auto mean = mean_over(u);
    slow.white += d.variance * mean.variance;
    add({d.variance * mean.neighbours * std::exp(u), std::exp(-u)});
  }
  const double of_shared = is_shared ? add(*shared) : 0.0;
  // Where the density is least, something must be left of it. Beside a motion that is not yet
  // explained, what passes for a walk is none, and need not be as smooth from mean to mean.
  constexpr double share_left = 0.02, least_beside_motion = 0.05;
  slow.white =
      std::max(slow.white, reduced.is_beside_motion()
                               ? least_beside_motion * slow.walk + (share_left - 1.0) * of_shared
                               : share_left * size - at_the_fastest);
  return slow;
}

}  // namespace

SlowLaw slow_law(const ReducedRate& reduced, const NoiseLaw& law, std::size_t cluster) {
  const double interval_s = law.interval_s * static_cast<double>(cluster);
  const auto bands = bands_of(law, interval_s);
  DensityParts parts;
  const auto density = density_of(bands.fast, reduced.grid().angles(), parts);
  return slow_law_of(reduced, bands, density, parts.gain_of_white, interval_s);
}

double fast_ratio(const ReducedRate& reduced, const NoiseLaw& law) {
  const auto& seen = reduced.periodogram();
  if (seen.empty()) return 1.0;
  const auto density = reduced.grid().shown(density_of(law, reduced.grid().angles()));
  double sum = 0.0, bins = 0.0;
  for (std::size_t k = reduced.grid().first_fast_bin(); k + 1 < density.size(); ++k)
    sum += seen[k] / density[k], bins += 1.0;
  return sum / bins;
}

RateBands rate_bands(const ReducedRate& reduced, const NoiseLaw& law, DensityParts near) {
  const double interval_s = law.interval_s * std::round(reduced.cluster_s() / law.interval_s);
  const auto bands = bands_of(law, interval_s);
  auto density = density_of(bands.fast, reduced.grid().angles(), near);
  RateBands found{.slow = slow_law_of(reduced, bands, density, near.gain_of_white, interval_s),
                  .fast = {},
                  .parts = std::move(near)};
  const auto& seen = reduced.periodogram();
  if (seen.empty()) return found;
  const auto slow_density = density_of(bands.slow, reduced.grid().angles());
  for (std::size_t k = 0; k < density.size(); ++k) density[k] += slow_density[k];
  density = reduced.grid().shown(density);
  double sum = 0.0;
  for (std::size_t k = reduced.grid().first_fast_bin(); k + 1 < density.size(); ++k) {
    const double log_density = std::log(density[k]);
    found.fast.log_density.push_back(log_density);
    sum += log_density + seen[k] / density[k];
  }
  found.fast.log_likelihood = -reduced.degrees() * sum;
  return found;
}

SlowTerms slow_terms(const ReducedRate& reduced, const SlowLaw& law,
                     const Eigen::MatrixXd& regressors, const Eigen::VectorXd& prior_std,
                     const SlowTerms* near, bool is_the_last) {
  const auto& slow = reduced.slow(Part::train);
  if (slow.points.size() < 2) return {};
  Eigen::MatrixXd chosen(slow.means.size(), regressors.cols());
  for (Eigen::Index k = 0; k < chosen.rows() && chosen.cols() > 0; ++k)
    chosen.row(k) =
        regressors.row(static_cast<Eigen::Index>(slow.points[static_cast<std::size_t>(k)]));
  return slow_terms(law, slow.points, slow.means, chosen, prior_std, near, is_the_last);
}

}  // namespace gyrostat::gap
