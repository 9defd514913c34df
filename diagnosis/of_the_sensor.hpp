#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/series.hpp>

namespace gyrostat::gap {

/// The recording without what is not the sensor's: its handling, a heading that is no compass,
/// turns that nobody knows, noise of the reference, the times of another clock, and what the gyro
/// shows of a motion before the reference begins. `told` hears of each.
Series of_the_sensor(Series recording, std::vector<std::string>& told);

}  // namespace gyrostat::gap
