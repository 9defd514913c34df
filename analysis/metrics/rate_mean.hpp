#pragma once

#include <string_view>

#include "analysis/errors.hpp"

namespace gyrostat::metrics {

/// Mean over time of gyro - estimate - true rate.
struct RateMean {
  static constexpr std::string_view title = "compensated rate error, mean";
  static constexpr std::string_view unit = "dps";

  double operator()(const TrackErrors& errors) const { return errors.rate.mean; }
};

}  // namespace gyrostat::metrics
