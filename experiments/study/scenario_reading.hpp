#pragma once

#include <array>
#include <memory>
#include <string>

#include <gyrostat/experiments/study/recorded.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat {

class Fleet;

/// Keys of a scenario whose objects name a "file".
inline constexpr std::array scenario_sources = {"from_recording", "from_fleet", "conditions_from"};

/// A scenario from its JSON, as a study's "scenario" has it; recordings are relative to `folder`.
/// With "from_fleet" it is the nominal one, and what each trial's is drawn from is put into
/// `fleet`; where that is null, a fleet is refused.
Scenario read_scenario(JsonObject object, const std::string& folder, FittedRecordings& fits,
                       std::shared_ptr<const Fleet>* fleet = nullptr);

}  // namespace gyrostat
