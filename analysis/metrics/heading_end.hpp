#pragma once

#include <string_view>

#include "analysis/errors.hpp"

namespace gyrostat::metrics {

/// Heading error at the last sample, integrated from the compensated rate.
struct HeadingEnd {
  static constexpr std::string_view title = "heading error at the end";
  static constexpr std::string_view unit = "deg";

  double operator()(const TrackErrors& errors) const { return errors.heading.end_deg; }
};

}  // namespace gyrostat::metrics
