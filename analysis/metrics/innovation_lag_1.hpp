#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Autocorrelation of successive normalised innovations (Bar-Shalom et al. 2001, eq. 5.4.2-9): 0
/// but for a standard deviation of 1 / sqrt(innovations) for a consistent filter.
struct InnovationLag1 {
  static constexpr std::string_view title = "autocorrelation of successive innovations";
  static constexpr std::string_view unit = "1";
  static constexpr Goal goal = Goal::consistent;

  double operator()(const TrackErrors& errors) const { return errors.innovations.lag_1; }
};

}  // namespace gyrostat::metrics
