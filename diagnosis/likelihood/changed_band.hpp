#pragma once

#include <vector>

namespace gyrostat::gap {

/// Where most of a change of power lies: the middle two thirds of what is added, or of what is
/// taken away where that is more.
struct ChangedBand {
  bool adds;
  double from_hz, to_hz;
};

/// Of the change at each bin of a spectrum.
ChangedBand changed_band(const std::vector<double>& change, double resolution_hz);

}  // namespace gyrostat::gap
