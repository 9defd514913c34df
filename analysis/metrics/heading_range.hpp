#pragma once

#include <string_view>

#include "analysis/errors.hpp"

namespace gyrostat::metrics {

/// Highest minus lowest heading error over time.
struct HeadingRange {
  static constexpr std::string_view title = "heading error, range";
  static constexpr std::string_view unit = "deg";

  double operator()(const TrackErrors& errors) const {
    return errors.heading.max_deg - errors.heading.min_deg;
  }
};

}  // namespace gyrostat::metrics
