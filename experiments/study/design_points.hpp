#pragma once

#include <cstddef>
#include <cstdint>

#include <gyrostat/experiments/study/design.hpp>

namespace gyrostat {

/// Fills points, values and labels of a design whose kind and parameters are read. `count` is of
/// points, trajectories (morris) or rows (saltelli, surrogate).
void place_points(std::size_t count, std::uint64_t seed, Design& design);

}  // namespace gyrostat
