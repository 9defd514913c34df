#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Squared bias estimation error over the variance that the filter states, at the last sample: one
/// degree of freedom a trial, so that the mean over N trials of a consistent filter is chi-squared
/// with N over N (Bar-Shalom et al. 2001, sec. 5.4.2). Needs the truth.
struct NeesEnd {
  static constexpr std::string_view title = "normalised estimation error squared, at the end";
  static constexpr std::string_view unit = "1";
  static constexpr Goal goal = Goal::consistent;

  double operator()(const TrackErrors& errors) const { return errors.covariance.nees_end; }
};

}  // namespace gyrostat::metrics
