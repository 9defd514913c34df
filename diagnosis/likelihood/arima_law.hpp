#pragma once

#include <algorithm>
#include <cmath>

#include <gyrostat/core/models/arima111.hpp>

namespace gyrostat::gap {

/// ARIMA(1,1,1) as a sum of two errors, by the partial fractions of its spectrum:
///
///     |d1 - d2 z|^2 / (|1 - phi z|^2 |1 - z|^2)  =  walk^2 / |1 - z|^2  +  memory / |1 - phi z|^2
///
/// (the spectrum: Box, Jenkins and Reinsel, "Time Series Analysis", 4th ed., 2.2 and 4.1). Where
/// `memory` is below 0 the two are not independent, and the walk is smoother than a walk.
struct ArimaLaw {
  double phi = 0.0;
  double walk_dps = 0.0;  ///< standard deviation of the walk's step in a sample
  double memory = 0.0;    ///< variance of the decaying error's innovation, dps²

  static ArimaLaw of(const Arima111<double>& e) {
    const double walk = (e.delta1_dps - e.delta2_dps) / (1.0 - e.phi);
    const double sum = e.delta1_dps + e.delta2_dps, from_walk = walk * (1.0 + e.phi);
    // Without phi and delta2 there is nothing but the walk, exactly.
    return {e.phi, std::abs(walk),
            e.phi == 0.0 && e.delta2_dps == 0.0 ? 0.0 : 0.25 * (sum * sum - from_walk * from_walk)};
  }

  /// Variance of the decaying error, dps².
  double variance() const { return memory / ((1.0 - phi) * (1.0 + phi)); }

  void put(Arima111<double>& e) const {
    const double from_walk = walk_dps * (1.0 + phi);
    const double sum = std::sqrt(std::max(0.0, from_walk * from_walk + 4.0 * memory));
    const double difference = walk_dps * (1.0 - phi);
    e.phi = phi;
    e.delta1_dps = 0.5 * (sum + difference);
    e.delta2_dps = 0.5 * (sum - difference);
  }
};

}  // namespace gyrostat::gap
