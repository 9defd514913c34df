#pragma once

#include <string_view>

#include "analysis/errors.hpp"

namespace gyrostat::metrics {

/// RMSE over time of gyro - estimate - true rate.
struct RateRmse {
  static constexpr std::string_view title = "compensated rate error, RMSE";
  static constexpr std::string_view unit = "dps";

  double operator()(const TrackErrors& errors) const { return errors.rate.rmse; }
};

}  // namespace gyrostat::metrics
