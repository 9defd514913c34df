#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Highest heading error over time.
struct HeadingMax {
  static constexpr std::string_view title = "heading error, highest";
  static constexpr std::string_view unit = "deg";
  static constexpr Goal goal = Goal::near_zero;

  double operator()(const TrackErrors& errors) const { return errors.heading.max_deg; }
};

}  // namespace gyrostat::metrics
