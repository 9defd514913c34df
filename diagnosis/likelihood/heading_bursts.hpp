#pragma once

#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// What comes and goes in a heading.
struct HeadingBursts {
  std::vector<char> hidden;  ///< a flag a cluster: within a burst
  double gain = 0.0;         ///< log-likelihood, less what finding each place costs
  double per_hour = 0.0, duration_s = 0.0, size_deg = 0.0;
};

/// Runs of the train part that are far out, cluster by cluster or as a whole, in an error whose
/// means of clusters are given (deg; NaN: unknown). Clusters in `misled` (a flag each) are far out
/// for themselves alone: what is small there may be another effect's form.
HeadingBursts heading_bursts(const Conditions& conditions, std::vector<double> means_deg,
                             const std::vector<char>& misled);

}  // namespace gyrostat::gap
