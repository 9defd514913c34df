#pragma once

#include <gyrostat/diagnosis/likelihood/noise_law.hpp>
#include <gyrostat/diagnosis/likelihood/reduced_rate.hpp>
#include <gyrostat/diagnosis/likelihood/slow_filter.hpp>

namespace gyrostat::gap {

/// A log-likelihood with the terms that a Fisher score needs.
struct RateTerms {
  double log_likelihood = 0.0;
  SlowTerms slow;
  std::vector<double> log_density;  ///< at the fast bins
};

/// How likely a part of a recording is under a law of the noise: cluster means by an exact
/// likelihood, frequencies above those that cluster means show by Whittle's (Whittle, Ark. Mat. 2,
/// 1953). `regressors` (cluster x any) are of unknown size, but for their priors (SlowTerms).
RateTerms rate_terms(const ReducedRate& reduced, const NoiseLaw& law,
                     const Eigen::MatrixXd& regressors, const Eigen::VectorXd& prior_std);

/// Mean ratio of the train part's periodogram to the law at fast frequencies; 1 where there are
/// none.
double fast_ratio(const ReducedRate& reduced, const NoiseLaw& law);

/// The law of cluster means under the law of samples.
SlowLaw slow_law(const ReducedRate& reduced, const NoiseLaw& law, std::size_t cluster);

}  // namespace gyrostat::gap
