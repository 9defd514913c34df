#pragma once

#include <algorithm>
#include <string_view>

#include "analysis/errors.hpp"

namespace gyrostat::metrics {

/// Farthest that the heading error gets from zero, to either side.
struct HeadingWorst {
  static constexpr std::string_view title = "heading error, largest";
  static constexpr std::string_view unit = "deg";

  double operator()(const TrackErrors& errors) const {
    return std::max(errors.heading.max_deg, -errors.heading.min_deg);
  }
};

}  // namespace gyrostat::metrics
