#pragma once

#include <cstddef>
#include <span>

#include "core/types.hpp"

namespace gyrostat {

/// The difference of two methods over trials that both have run, in the metric's unit.
struct PairedDifference {
  std::size_t count = 0;  ///< trials where both have a value
  double mean = no_value;
  double half_width = no_value;     ///< of the interval, simultaneous over the family
  double p_adjusted = no_value;     ///< Bonferroni over the family, two-sided t test
  bool separable = false;           ///< the simultaneous interval excludes 0
  double trials_needed = no_value;  ///< to separate a difference of this size with power 0.8
};

/// a - b, paired by trial (common random numbers), with a 95 % interval that holds simultaneously
/// over `family` comparisons (Bonferroni), so that the pair may be picked after looking.
PairedDifference paired_difference(std::span<const double> a, std::span<const double> b,
                                   std::size_t family);

/// The same from what the pairs add up to: the mean of a - b over `count` pairs and the sum of
/// squares about it.
PairedDifference paired_difference(std::size_t count, double mean, double squares, double family);

}  // namespace gyrostat
