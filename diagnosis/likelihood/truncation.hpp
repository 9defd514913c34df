#pragma once

#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// Whether values on a grid through zero were cut off towards zero, as a cast to an integer does:
/// 0 then stands for two steps, and every other value for one. Told from the counts of values next
/// to zero over the stretches of the train part.
bool is_cut_off(const Conditions& conditions, const std::vector<double>& gyro_dps, double lsb_dps);

/// Such values as the middles of what was cut off: a grid that is rounded to, half a step beside
/// zero. A zero is of either side with the odds that it has beside its stretch's level, and the
/// rate where that is known.
std::vector<double> middles_of_cut_off(const Conditions& conditions,
                                       const std::vector<double>& gyro_dps, double lsb_dps);

}  // namespace gyrostat::gap
