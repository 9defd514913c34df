#pragma once

#include <string>
#include <vector>

#include <gyrostat/experiments/study/json.hpp>

namespace gyrostat {

struct Cell;

/// The methods of `cell` that the list under `key` names, by their indices; all where it is absent.
/// Throws InputError for an unknown one, one that stands twice, and an empty list.
std::vector<std::size_t> chosen_methods(JsonObject& object, const std::string& key,
                                        const Cell& cell);

}  // namespace gyrostat
