#pragma once

#include <string_view>

#include "analysis/errors.hpp"

namespace gyrostat::metrics {

/// RMSE over time of estimate - (drift + random error); needs the truth.
struct BiasRmse {
  static constexpr std::string_view title = "bias estimation error, RMSE";
  static constexpr std::string_view unit = "dps";

  double operator()(const TrackErrors& errors) const { return errors.bias.rmse; }
};

}  // namespace gyrostat::metrics
