#pragma once

#include <set>
#include <string>

#include <gyrostat/diagnosis/likelihood/set_search.hpp>

namespace gyrostat::gap {

/// The effects of the set that the likelihood finds in a recording.
inline std::set<std::string> found_in(const Series& series) {
  const Simulator simulator(series, 1);
  std::set<std::string> names;
  for (const auto& member : find_set(simulator, series, {}).members) names.insert(member.effect);
  return names;
}

}  // namespace gyrostat::gap
