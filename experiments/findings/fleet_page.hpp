#pragma once

#include <string>
#include <vector>

#include <gyrostat/experiments/findings/shared_effects.hpp>

namespace gyrostat::gap {

/// What came out of each member, with a link to its own page (`pages`, one a member), and what they
/// share, as one HTML page. `kind` is what a member is: "axis", "sensor".
std::string fleet_page(const std::vector<FleetMember>& members, const std::string& kind,
                       const std::vector<std::string>& pages, const std::string& name);

}  // namespace gyrostat::gap
