#pragma once

#include <string_view>

#include "analysis/errors.hpp"

namespace gyrostat::metrics {

/// Lowest heading error over time.
struct HeadingMin {
  static constexpr std::string_view title = "heading error, lowest";
  static constexpr std::string_view unit = "deg";

  double operator()(const TrackErrors& errors) const { return errors.heading.min_deg; }
};

}  // namespace gyrostat::metrics
