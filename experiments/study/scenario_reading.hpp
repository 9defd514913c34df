#pragma once

#include <string>

#include <gyrostat/experiments/study/recorded.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat {

/// A scenario from its JSON, as a study's "scenario" has it; recordings are relative to `folder`.
Scenario read_scenario(JsonObject object, const std::string& folder, FittedRecordings& fits);

}  // namespace gyrostat
