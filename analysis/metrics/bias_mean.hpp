#pragma once

#include <string_view>

#include "analysis/errors.hpp"

namespace gyrostat::metrics {

/// Mean over time of estimate - (drift + random error); needs the truth.
struct BiasMean {
  static constexpr std::string_view title = "bias estimation error, mean";
  static constexpr std::string_view unit = "dps";

  double operator()(const TrackErrors& errors) const { return errors.bias.mean; }
};

}  // namespace gyrostat::metrics
