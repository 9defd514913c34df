#pragma once

#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// How much likelier, as a logarithm, the rate error of the train part becomes by what the
/// reference rate still explains of it through any short filter and any curve, beyond what chance
/// gives; 0 or less where nothing of the motion is left, and where there is no reference.
/// `left_dps` has a value a sample, without its level, and no_value where a sample does not count.
double log_gain_of_motion(const Conditions& conditions, const std::vector<double>& left_dps);

}  // namespace gyrostat::gap
