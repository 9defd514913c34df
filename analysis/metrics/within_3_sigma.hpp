#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Share of time in which the bias estimation error lies within 3 of the filter's own standard
/// deviations: 0.9973 for a consistent filter. Needs the truth.
struct Within3Sigma {
  static constexpr std::string_view title =
      "bias error within ±3σ of the filter's own, share of time";
  static constexpr std::string_view unit = "1";
  static constexpr Goal goal = Goal::consistent;

  double operator()(const TrackErrors& errors) const { return errors.covariance.within_3_sigma; }
};

}  // namespace gyrostat::metrics
