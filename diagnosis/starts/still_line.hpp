#pragma once

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// A line that remembers its phase for longer stands still as far as the recording tells.
inline double longest_memory_of_a_line_s(const Conditions& c) {
  constexpr double fewest_memories = 10.0;
  return c.interval_s() * static_cast<double>(c.size()) / fewest_memories;
}

}  // namespace gyrostat::gap
