#pragma once

#include <nlohmann/json_fwd.hpp>

namespace gyrostat {

/// For headers, which name JSON and read none: json_object.hpp has it whole.
using Json = nlohmann::ordered_json;
class JsonObject;
class Mistakes;

}  // namespace gyrostat
