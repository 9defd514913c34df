#pragma once

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/evidence.hpp>

namespace gyrostat::gap {

/// The largest reference rate, dps.
inline double fastest_dps(const Conditions& conditions) {
  double fastest = 0.0;
  for (const double rate : conditions.series().rate_ref_dps)
    fastest = std::max(fastest, std::abs(rate));
  return fastest;
}

}  // namespace gyrostat::gap
