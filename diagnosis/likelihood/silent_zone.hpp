#pragma once

#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// A dead zone of the output, as values show it: zeros, noise and bias included, wherever the rate
/// is small.
struct SilentZone {
  double half_width_dps = 0.0;  ///< 0: there is none
  double lost_beyond = 0.0;     ///< 1: larger outputs are less by the half width, 0: they are not
  /// A flag a sample: 0, or so near the zone that noise decides.
  std::vector<char> samples{};
};

/// Read off the train part. `grid_dps` is the step of the grid that the values are written on.
SilentZone silent_zone(const Conditions& conditions, const std::vector<double>& z, double grid_dps);

}  // namespace gyrostat::gap
