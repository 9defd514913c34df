#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Mean over time of the squared bias estimation error over the variance that the filter states
/// (Bar-Shalom et al. 2001, sec. 5.4.2): 1 for a consistent filter. Needs the truth.
struct Nees {
  static constexpr std::string_view title = "normalised estimation error squared, mean";
  static constexpr std::string_view unit = "1";
  static constexpr Goal goal = Goal::consistent;

  double operator()(const TrackErrors& errors) const { return errors.covariance.nees; }
};

}  // namespace gyrostat::metrics
