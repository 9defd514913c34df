#pragma once

#include <cstdint>

#include "core/table.hpp"

namespace gyrostat {

/// How often the nominal 95 % intervals of sensitivity indices hold the true value: designs over
/// Ishigami's and Sobol's functions, whose indices are known, with trial noise of its own at each
/// point, shared by all points, and with trials that fail; `repeats` new designs and noises each.
/// One row an interval, its coverage with the standard error that `repeats` leave it.
Table sensitivity_coverage(std::uint32_t repeats, std::uint64_t seed);

}  // namespace gyrostat
