#pragma once

#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// Flags the samples of blocks within which `left_dps` goes from one level to another.
std::vector<char> samples_beside_jumps(const std::vector<double>& left_dps,
                                       const std::vector<Span>& blocks);

}  // namespace gyrostat::gap
