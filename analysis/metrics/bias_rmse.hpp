#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// RMSE over time of estimate - (drift + random error); needs the truth.
struct BiasRmse {
  static constexpr std::string_view title = "bias estimation error, RMSE";
  static constexpr std::string_view unit = "dps";
  static constexpr Goal goal = Goal::near_zero;
  static constexpr TableOf table{
      .place = 1,
      .title = "bias estimation error (estimate - drift - random error), RMSE over time",
      .difference = "RMSE of the bias estimation error"};

  double operator()(const TrackErrors& errors) const { return errors.bias.rmse; }
};

}  // namespace gyrostat::metrics
