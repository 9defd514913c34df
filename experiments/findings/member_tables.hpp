#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/findings/shared_effects.hpp>

namespace gyrostat::gap {

/// A row a member, then what they share. `kind` is what a member is: "axis", "sensor".
std::vector<Table> member_tables(const std::vector<FleetMember>& members, const std::string& kind);

}  // namespace gyrostat::gap
