#pragma once

#include <algorithm>
#include <cmath>

namespace gyrostat::gap {

/// In some recordings a sample of the heading has turned by its own rate, in others by half of it
/// or not yet: the likeliest of these ways where the heading is late by so many samples.
inline double way_of_recorders(double late_samples) {
  return std::clamp(0.5 * std::round(2.0 * late_samples), -1.0, 1.0);
}

}  // namespace gyrostat::gap
