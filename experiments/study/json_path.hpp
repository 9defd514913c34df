#pragma once

#include <string>
#include <string_view>

#include <gyrostat/experiments/study/json.hpp>

namespace gyrostat {

/// Sets the value at a dotted path ("scenario.random_error.phi", "….disturbances.0.flagged",
/// "filters.stf.parameters.fading_factor"), making objects on the way. An entry of a list is named
/// by its index or by its "id", "filter" or "effect". Throws InputError at `place` where the path
/// leads through a number, a text or past a list's end.
void set_at(Json& json, const std::string& path, const Json& value, const std::string& place);

/// What stands behind the last dot of a path.
std::string last_part(const std::string& path);

}  // namespace gyrostat
