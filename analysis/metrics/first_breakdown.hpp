#pragma once

#include <cmath>
#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Time of the first step that broke down; no value where none did.
struct FirstBreakdown {
  static constexpr std::string_view title = "time of the first breakdown";
  static constexpr std::string_view unit = "s";
  static constexpr Goal goal = Goal::none;

  double operator()(const TrackErrors& errors) const { return errors.first_breakdown_s; }
};

}  // namespace gyrostat::metrics
