#pragma once

#include <string_view>

#include <gyrostat/analysis/statistics/running.hpp>

namespace gyrostat {

/// What a consistent filter's value stays within, with probability 1 - alpha.
struct Acceptance {
  double low = no_value, high = no_value;
  bool contains(double value) const { return value >= low && value <= high; }
};

/// Of the mean of `degrees` independent squares of standard normals: NIS over all innovations, NEES
/// at one time over all trials (Bar-Shalom, Li and Kirubarajan 2001, eq. 5.4.2-5).
Acceptance mean_square_bounds(double degrees, double alpha);

/// Of a chi-squared statistic that only too large a value counts against.
Acceptance chi_squared_bound(double degrees, double alpha);

/// Of a mean over trials whose expectation is `expected` (`skewed_mean_interval`): where samples
/// within a trial depend on each other, trials do not.
Acceptance trial_mean_bounds(const Running& over_trials, double expected, double alpha);

/// Of the autocorrelation about zero of `count` white normal values (same, eq. 5.4.2-10).
Acceptance correlation_bounds(double count, double alpha);

}  // namespace gyrostat
