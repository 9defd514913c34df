#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Highest minus lowest heading error over time.
struct HeadingRange {
  static constexpr std::string_view title = "heading error, range";
  static constexpr std::string_view unit = "deg";
  static constexpr Goal goal = Goal::near_zero;
  static constexpr TableOf table{.place = 6, .title = "heading error, highest minus lowest"};

  double operator()(const TrackErrors& errors) const {
    return errors.heading.max_deg - errors.heading.min_deg;
  }
};

}  // namespace gyrostat::metrics
