#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Lowest heading error over time.
struct HeadingMin {
  static constexpr std::string_view title = "heading error, lowest";
  static constexpr std::string_view unit = "deg";
  static constexpr Goal goal = Goal::near_zero;

  double operator()(const TrackErrors& errors) const { return errors.heading.min_deg; }
};

}  // namespace gyrostat::metrics
