#pragma once

#include <cmath>
#include <numbers>

namespace gyrostat {

/// Heading error of a field that turns as iron makes it, degrees: of one harmonic, as approximate
/// coefficients of deviation have it, or where `exact` is 1 as fields add up, whose overtones fall
/// by the amplitude in radians each (Smith and Evans, "Admiralty Manual for ascertaining and
/// applying the deviations of the compass", 1862, part 3). Both have that amplitude.
inline double compass_deviation_deg(double amplitude_deg, double angle_rad, double exact) {
  constexpr double rad = std::numbers::pi / 180.0;
  if (exact < 0.5) return amplitude_deg * std::sin(angle_rad);
  const double share = std::sin(amplitude_deg * rad);
  return std::atan2(share * std::sin(angle_rad), 1.0 - share * std::cos(angle_rad)) / rad;
}

}  // namespace gyrostat
