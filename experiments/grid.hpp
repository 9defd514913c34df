#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/json_object.hpp"

namespace gyrostat {

/// Sets the value at a dotted path ("scenario.random_error.phi", "….disturbances.0.flagged"),
/// making objects on the way. Throws InputError at `place` where the path leads through a number,
/// a text or past a list's end.
void set_at(Json& json, const std::string& path, const Json& value, const std::string& place);

/// The cells that a cell with a "grid" stands for: {"grid": {"path": [values], …}} becomes one cell
/// for each combination, named name[last part of path=value, …]. A cell without one is itself.
std::vector<std::pair<Json, std::string>> expand_grid(const Json& cell, const std::string& place);

}  // namespace gyrostat
