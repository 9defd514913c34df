#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace gyrostat::gap {

/// Half of a normal variable lies within so many standard deviations of its mean.
inline constexpr double normal_quartile = 0.6744897501960817;

/// The value below which `share` of `values` lie; 0 of none.
double quantile(std::vector<double> values, double share);

/// Probability that a normal value is below an edge.
inline double below(double edge, double level, double deviation) {
  return 0.5 * std::erfc((level - edge) / (deviation * std::numbers::sqrt2));
}

}  // namespace gyrostat::gap
