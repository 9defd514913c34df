#pragma once

#include <cstdint>
#include <vector>

#include <gyrostat/core/table.hpp>

namespace gyrostat {

/// How often the nominal 95 % intervals of sensitivity indices hold the true value: designs over
/// Ishigami's and Sobol's functions, whose indices are known, with trial noise of its own at each
/// point, shared by all points, and with trials that fail; `repeats` new designs and noises each.
/// `intervals` has a row for each, its coverage with the standard error that `repeats` leave it;
/// `groups` the least, mean and largest coverage by kind of index and noise.
std::vector<NamedTable> sensitivity_coverage(std::uint32_t repeats, std::uint64_t seed);

}  // namespace gyrostat
