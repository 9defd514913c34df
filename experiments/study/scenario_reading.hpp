#pragma once

#include <memory>
#include <string>

#include <gyrostat/experiments/study/recorded.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat {

class Fleet;

/// A scenario from its JSON, as a study's "scenario" has it; recordings are relative to `folder`.
/// With "from_fleet" it is the nominal one, and what each trial's is drawn from is put into
/// `fleet`; where that is null, a fleet is refused.
Scenario read_scenario(JsonObject object, const std::string& folder, FittedRecordings& fits,
                       std::shared_ptr<const Fleet>* fleet = nullptr);

}  // namespace gyrostat
