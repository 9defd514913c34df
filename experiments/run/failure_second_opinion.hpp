#pragma once

#include <optional>

#include <gyrostat/analysis/rare/importance_sampling.hpp>
#include <gyrostat/experiments/run/failing_means.hpp>

namespace gyrostat {

/// A failure's probability by importance sampling along the direction that failing trials have in
/// common, which the search's own runs know nothing of.
struct SecondOpinion {
  double closeness = 0.0;  ///< estimated cosine of the direction's angle to what fails most likely
  std::uint32_t trials = 0;
  /// Nothing where too few of them fail: the direction is known too little.
  std::optional<RareProbability> probability;
};

/// By trials numbered from `first`, which no other noise of the seed has; in parallel, with the
/// same result on any number of threads. Nothing where runs have no direction in common, or nothing
/// along it fails.
std::optional<SecondOpinion> second_opinion(const PreparedCell& prepared, const FailureRule& rule,
                                            const FailingMeans& means, std::uint32_t first,
                                            std::uint64_t seed);

}  // namespace gyrostat
