#pragma once

#include <string_view>

#include "analysis/errors.hpp"

namespace gyrostat::metrics {

/// Standard deviation over time of estimate - (drift + random error); needs the truth.
struct BiasStd {
  static constexpr std::string_view title = "bias estimation error, standard deviation";
  static constexpr std::string_view unit = "dps";

  double operator()(const TrackErrors& errors) const { return errors.bias.std; }
};

}  // namespace gyrostat::metrics
