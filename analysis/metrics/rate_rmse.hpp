#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// RMSE over time of gyro - estimate - true rate.
struct RateRmse {
  static constexpr std::string_view title = "compensated rate error, RMSE";
  static constexpr std::string_view unit = "dps";
  static constexpr Goal goal = Goal::near_zero;
  static constexpr TableOf table{.place = 2, .title = "compensated rate error, RMSE over time"};

  double operator()(const TrackErrors& errors) const { return errors.rate.rmse; }
};

}  // namespace gyrostat::metrics
