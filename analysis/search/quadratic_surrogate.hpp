#pragma once

#include <cstddef>
#include <vector>

namespace gyrostat {

/// How many points a quadratic of so many coordinates needs at least.
std::size_t surrogate_terms(std::size_t coordinates);

/// The minimum within the cube |u_i - centre_i| <= radius, and within the unit cube, of the
/// quadratic that fits `heights` at `points` best. A height counts by 1 / (1 + e)², e its excess
/// over the lowest in units of the median excess, so that what is many times worse does not bend
/// the surface near the lowest. From seven coordinates on it has no products.
std::vector<double> surrogate_minimum(const std::vector<std::vector<double>>& points,
                                      const std::vector<double>& heights,
                                      const std::vector<double>& centre, double radius);

}  // namespace gyrostat
