#pragma once

#include <cstddef>
#include <vector>

namespace gyrostat::gap {

/// How many different numbers there are; in time proportional to their count.
std::size_t distinct_values(const std::vector<double>& values);

}  // namespace gyrostat::gap
