#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Mean over time of estimate - (drift + random error); needs the truth.
struct BiasMean {
  static constexpr std::string_view title = "bias estimation error, mean";
  static constexpr std::string_view unit = "dps";
  static constexpr Goal goal = Goal::near_zero;

  double operator()(const TrackErrors& errors) const { return errors.bias.mean; }
};

}  // namespace gyrostat::metrics
