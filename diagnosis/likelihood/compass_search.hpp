#pragma once

#include <gyrostat/diagnosis/likelihood/set_search.hpp>

namespace gyrostat::gap {

/// The same search for the compass, whose errors are white noise, bursts, and what hard iron, soft
/// iron and a lag add.
void search_compass(const Simulator& simulator, const Series& recording,
                    const SetSearchOptions& options, FoundSet& found);

}  // namespace gyrostat::gap
