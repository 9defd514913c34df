#pragma once

#include <vector>

#include <gyrostat/diagnosis/likelihood/compass_errors.hpp>
#include <gyrostat/diagnosis/likelihood/walking_level.hpp>

namespace gyrostat::gap {

/// Whether values at the end of their range may leave it: a lag of none has no slope to go by.
enum class AtEnds { move, stay };

/// The effects after one step of Gauss and Newton in all their free parameters, within their
/// ranges, towards the least squares of the heading's errors about a level that walks, which are
/// `here` at the set; clusters that are `hidden` do not count.
std::vector<Effect> compass_step(const CompassErrors& errors, const Conditions& conditions,
                                 const std::vector<char>& hidden, const std::vector<Effect>& set,
                                 const std::vector<double>& here, const WalkingLevel& level,
                                 AtEnds at_ends = AtEnds::move);

}  // namespace gyrostat::gap
