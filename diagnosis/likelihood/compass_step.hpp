#pragma once

#include <vector>

#include <gyrostat/diagnosis/likelihood/compass_errors.hpp>

namespace gyrostat::gap {

/// The effects after one step of Gauss and Newton in all their free parameters, within their
/// ranges, towards the least squares of the heading's errors; clusters that are `hidden` do not
/// count.
std::vector<Effect> compass_step(const CompassErrors& errors, const Conditions& conditions,
                                 const std::vector<char>& hidden, const std::vector<Effect>& set);

}  // namespace gyrostat::gap
