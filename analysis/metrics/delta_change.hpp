#pragma once

#include <cmath>
#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Distance of the estimates of delta1 and delta2 at the end from their initial values; no value
/// for filters that do not carry them.
struct DeltaChange {
  static constexpr std::string_view title = "how far delta1 and delta2 moved";
  static constexpr std::string_view unit = "dps";
  static constexpr Goal goal = Goal::none;

  double operator()(const TrackErrors& errors) const {
    return std::hypot(errors.learned_last.delta1_dps - errors.learned_first.delta1_dps,
                      errors.learned_last.delta2_dps - errors.learned_first.delta2_dps);
  }
};

}  // namespace gyrostat::metrics
