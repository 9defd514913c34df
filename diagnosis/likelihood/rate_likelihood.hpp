#pragma once

#include <gyrostat/diagnosis/likelihood/noise_law.hpp>
#include <gyrostat/diagnosis/likelihood/reduced_rate.hpp>
#include <gyrostat/diagnosis/likelihood/slow_filter.hpp>

namespace gyrostat::gap {

/// What a law says of frequencies above those that cluster means show, and how likely it makes them
/// by Whittle's likelihood (Whittle, Ark. Mat. 2, 1953).
struct FastTerms {
  double log_likelihood = 0.0;
  std::vector<double> log_density;  ///< at the fast bins
};

/// A law in both bands of a recording.
struct RateBands {
  SlowLaw slow;  ///< of cluster means
  FastTerms fast;
  DensityParts parts;  ///< of what is fast
};
/// `near` are parts of the bands of another law of the same recording.
RateBands rate_bands(const ReducedRate& reduced, const NoiseLaw& law, DensityParts near = {});

/// How likely the train part of a recording is under a law of the noise, with the terms that a
/// Fisher score needs: cluster means by an exact likelihood, faster frequencies by Whittle's.
struct RateTerms {
  double log_likelihood = 0.0;
  RateBands bands;
  SlowTerms slow;
};

/// `regressors` (cluster x any) are of unknown size, but for their priors (SlowTerms); `near` and
/// `is_the_last` as there.
SlowTerms slow_terms(const ReducedRate& reduced, const SlowLaw& law,
                     const Eigen::MatrixXd& regressors, const Eigen::VectorXd& prior_std,
                     const SlowTerms* near = nullptr, bool is_the_last = false);

/// Mean ratio of the train part's periodogram to the law at fast frequencies; 1 where there are
/// none.
double fast_ratio(const ReducedRate& reduced, const NoiseLaw& law);

}  // namespace gyrostat::gap
