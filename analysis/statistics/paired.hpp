#pragma once

#include <cstddef>
#include <span>

#include <gyrostat/analysis/statistics/running.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// The difference of two methods over trials that both have run, in the metric's unit.
struct PairedDifference {
  std::size_t count = 0;  ///< trials where both have a value
  double mean = no_value;
  double low = no_value, high = no_value;  ///< of the interval, simultaneous over the family
  double p_adjusted = no_value;            ///< Bonferroni over the family, by the same interval
  bool separable = false;                  ///< the simultaneous interval excludes 0
  double trials_needed = no_value;         ///< to separate a difference of this size with power 0.8
};

/// a - b, paired by trial (common random numbers), with a 95 % interval that holds simultaneously
/// over `family` comparisons (Bonferroni), so that the pair may be picked after looking, and allows
/// for skewed differences (`skewed_mean_interval`).
///
/// Example: two methods on the same four trials, the only comparison that is made.
///
///   const std::vector<double> kf = {0.021, 0.034, 0.019, 0.028};
///   const std::vector<double> stf = {0.024, 0.036, 0.024, 0.031};
///   const PairedDifference difference = paired_difference(kf, stf, 1);
///   if (difference.separable) std::puts(difference.mean < 0.0 ? "kf wins" : "stf wins");
///
/// Thread safety: may run in any number of threads at once.
PairedDifference paired_difference(std::span<const double> a, std::span<const double> b,
                                   std::size_t family);

/// The same from the differences' own count, mean and sums about it.
PairedDifference paired_difference(const Running& differences, double family);

}  // namespace gyrostat
