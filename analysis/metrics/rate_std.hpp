#pragma once

#include <string_view>

#include "analysis/errors.hpp"

namespace gyrostat::metrics {

/// Standard deviation over time of gyro - estimate - true rate.
struct RateStd {
  static constexpr std::string_view title = "compensated rate error, standard deviation";
  static constexpr std::string_view unit = "dps";

  double operator()(const TrackErrors& errors) const { return errors.rate.std; }
};

}  // namespace gyrostat::metrics
