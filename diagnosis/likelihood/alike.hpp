#pragma once

#include <vector>

#include <gyrostat/diagnosis/likelihood/set_search.hpp>

namespace gyrostat::gap {

/// What the axes of one sensor have alike (CauseType::part), of each axis: found by the sum of
/// their likelihoods, where that is larger, less what alike parameters cost once, than with each
/// axis' own, less what these cost each time. Axes that differ by more than that keep their own.
/// The sets are those of find_set(), and are asked.
std::vector<std::vector<Given>> alike_on_axes(const std::vector<FoundSet>& axes);

}  // namespace gyrostat::gap
