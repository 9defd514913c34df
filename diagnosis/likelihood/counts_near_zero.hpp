#pragma once

#include <array>
#include <vector>

namespace gyrostat::gap {

/// Steps either side of zero that are counted.
inline constexpr int reach_of_zero = 3;

/// How often each value from -reach_of_zero to reach_of_zero steps was written in a stretch over
/// which the level hardly moves.
using CountsNearZero = std::array<double, 2 * reach_of_zero + 1>;

/// Whether these counts are those of values cut off towards zero, whose cell at zero is twice as
/// wide as others, and not of rounded ones. By the profile likelihoods of both under one noise,
/// normal or with a share of wider values, and levels of each stretch; and by chi-squared, of which
/// what is cut off has to leave less than a fifth. Half a step of noise about a level that rests
/// tells neither.
bool are_cut_off(std::vector<CountsNearZero> stretches);

}  // namespace gyrostat::gap
