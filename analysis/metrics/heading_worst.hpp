#pragma once

#include <algorithm>
#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Farthest that the heading error gets from zero, to either side.
struct HeadingWorst {
  static constexpr std::string_view title = "heading error, largest";
  static constexpr std::string_view unit = "deg";
  static constexpr Goal goal = Goal::near_zero;

  double operator()(const TrackErrors& errors) const {
    return std::max(errors.heading.max_deg, -errors.heading.min_deg);
  }
};

}  // namespace gyrostat::metrics
