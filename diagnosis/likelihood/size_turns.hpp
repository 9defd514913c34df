#pragma once

#include <cstddef>
#include <vector>

namespace gyrostat::gap {

/// How often a sample the size of innovations goes round: at the line that their squares, about a
/// variance of `narrow`, have where it is clear and its period neither below 3.3 samples, as clocks
/// slip (`noise_averaging`), nor as long as bursts are apart; else 0. A square a sample, of those that are named.
double turns_of(const std::vector<std::size_t>& samples, const std::vector<double>& squares,
                double narrow);

}  // namespace gyrostat::gap
