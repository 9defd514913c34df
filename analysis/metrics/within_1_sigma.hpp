#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Share of time in which the bias estimation error lies within 1 of the filter's own standard
/// deviations: 0.683 for a consistent filter. Needs the truth.
struct Within1Sigma {
  static constexpr std::string_view title =
      "bias error within ±1σ of the filter's own, share of time";
  static constexpr std::string_view unit = "1";
  static constexpr Goal goal = Goal::consistent;

  double operator()(const TrackErrors& errors) const { return errors.covariance.within_1_sigma; }
};

}  // namespace gyrostat::metrics
