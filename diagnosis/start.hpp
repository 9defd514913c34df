#pragma once

#include <limits>

#include <gyrostat/core/models/arima111.hpp>
#include <gyrostat/core/models/thermal_drift.hpp>
#include <gyrostat/generators/effect.hpp>

namespace gyrostat::gap {

/// Random error and thermal drift of a recording: the baseline's, or what is left of them beside an
/// effect.
struct Rest {
  Arima111<double> random_error;
  ThermalDrift<double> thermal_drift;
};

/// An effect with first parameters, and what is left beside it.
struct Start {
  Effect effect;
  Rest rest;
  /// No more log score than this can be due to the effect: of a slow signature half its squared
  /// t-statistic, since a random walk imitates every slow curve.
  double most_gain = std::numeric_limits<double>::infinity();
};

}  // namespace gyrostat::gap
