#pragma once

#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// The blocks, over which a level is taken, within one part each.
std::vector<Span> level_blocks(const Conditions& conditions);

/// Leaves of a value a sample what is not level over those blocks: from the middle of one to that
/// of the next the level is a straight line, since a step between them would be an innovation of
/// its own. NaN where missing.
void take_out_level(const Conditions& conditions, std::vector<double>& values);

}  // namespace gyrostat::gap
