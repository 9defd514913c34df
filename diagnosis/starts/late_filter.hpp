#pragma once

#include <vector>

#include <gyrostat/diagnosis/evidence.hpp>

namespace gyrostat::gap {

/// A shift of time and a filter together, a start for each form of the filter: what either of them
/// is alone, where both are there, is no place to find the other from. The shift that each cutoff
/// leaves is by Gauss and Newton, from what a shift alone is later than the filter.
std::vector<std::vector<Effect>> late_filters(const Evidence& evidence);

}  // namespace gyrostat::gap
