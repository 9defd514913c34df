#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Mean over time of gyro - estimate - true rate.
struct RateMean {
  static constexpr std::string_view title = "compensated rate error, mean";
  static constexpr std::string_view unit = "dps";
  static constexpr Goal goal = Goal::near_zero;
  static constexpr TableOf table{.place = 4, .title = "compensated rate error, mean over time"};

  double operator()(const TrackErrors& errors) const { return errors.rate.mean; }
};

}  // namespace gyrostat::metrics
