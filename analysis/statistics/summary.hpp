#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include <gyrostat/analysis/statistics/running.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// The spread over trials of one metric. `percentile_95` and `worst` are of the absolute value.
struct Summary {
  std::size_t count = 0;    ///< trials that have a value
  std::size_t missing = 0;  ///< trials that have none (NaN)
  double mean = no_value;
  double half_width_95 = no_value;  ///< of the mean's 95 % interval
  double std = no_value;
  double median = no_value;
  double percentile_95 = no_value;
  double worst = no_value;
};

/// Statistics of `values`; NaN entries are counted as missing. Order does not change the result
/// beyond the order of summation.
///
/// Example: mean and interval of three trials, of which one has no value.
///
///   const std::vector<double> errors_dps = {0.02, 0.03, no_value};
///   const Summary summary = summarise(errors_dps);
///   std::printf("%g +- %g, %zu missing\n", summary.mean, summary.half_width_95, summary.missing);
///
/// Thread safety: may run in any number of threads at once.
Summary summarise(std::span<const double> values);

/// Distance from the mean of the farther end of its 95 % interval (`skewed_mean_reach`): ± as
/// much is right at both ends, one-sided. No value for fewer than two values.
double half_width_95(const Running& values);

}  // namespace gyrostat
