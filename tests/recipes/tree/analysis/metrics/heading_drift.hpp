#pragma once

#include <cmath>
#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// How far the integrated heading is off at the end, whatever the side.
struct HeadingDrift {
  static constexpr std::string_view title = "heading error at the end, its size";
  static constexpr std::string_view unit = "deg";
  static constexpr Goal goal = Goal::small;

  double operator()(const TrackErrors& errors) const { return std::abs(errors.heading.end_deg); }
};

}  // namespace gyrostat::metrics
