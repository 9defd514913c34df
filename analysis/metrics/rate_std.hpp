#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Standard deviation over time of gyro - estimate - true rate.
struct RateStd {
  static constexpr std::string_view title = "compensated rate error, standard deviation";
  static constexpr std::string_view unit = "dps";
  static constexpr Goal goal = Goal::near_zero;
  static constexpr TableOf table{.place = 3,
                                 .title = "compensated rate error, standard deviation over time"};

  double operator()(const TrackErrors& errors) const { return errors.rate.std; }
};

}  // namespace gyrostat::metrics
