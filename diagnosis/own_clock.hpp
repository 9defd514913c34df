#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/series.hpp>

namespace gyrostat::gap {

/// The recording of a sensor whose clock is slower than the recorder's by no whole number
/// (SlowerClock), beside a reference rate: its values are up to a sample older than the times that
/// they have, now more, now less. Each is moved by what the reference turned meanwhile, so that
/// they are what the sensor would have shown at their times; repeats stay repeats. On a grid, where
/// that would be no value, they stay as they are, as they do in a recording that is too long to be
/// looked at in one go. `told` hears of it.
Series at_the_recorders_times(Series recording, std::vector<std::string>& told);

}  // namespace gyrostat::gap
