#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/series.hpp>

namespace gyrostat::gap {

/// The recording without what its heading shows of a motion before the reference begins: where it
/// is late, and the reference moves, its first eight times that are missing. `told` hears of it.
Series with_known_heading(Series recording, std::vector<std::string>& told);

}  // namespace gyrostat::gap
