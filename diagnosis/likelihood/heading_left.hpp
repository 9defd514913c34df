#pragma once

#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// How much likelier, as a logarithm, errors of the heading become by what the reference's rates, a
/// few samples before and after, and the direction itself still explain of them, beyond what chance
/// gives. `errors_deg` has a value a sample, no_value where it does not count; they are white about
/// a level that walks (WalkingLevel), and `share` of them are independent.
double log_gain_of_turning(const Conditions& conditions, const std::vector<double>& errors_deg,
                           double level_gain, double share);

}  // namespace gyrostat::gap
