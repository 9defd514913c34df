#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Heading error at the last sample, integrated from the compensated rate.
struct HeadingEnd {
  static constexpr std::string_view title = "heading error at the end";
  static constexpr std::string_view unit = "deg";
  static constexpr Goal goal = Goal::near_zero;
  static constexpr TableOf table{.place = 5, .title = "heading error at the end"};

  double operator()(const TrackErrors& errors) const { return errors.heading.end_deg; }
};

}  // namespace gyrostat::metrics
