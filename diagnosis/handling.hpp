#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/series.hpp>

namespace gyrostat::gap {

/// How long the two ends of a recording at rest are at which the sensor was put down or taken up.
struct Handling {
  double first_s = 0.0, last_s = 0.0;
};

/// Handling is a burst that reaches to an end of the recording and has no like within it: runs of a
/// tenth of a second (eight samples at least) whose deviation from a straight line is five times
/// the median one, on any of the gyro's axes, and the run beside them. No more than a twentieth of
/// the recording is taken for it, and nothing of one with a reference rate, which may move.
Handling handling_of(const Series& recording);

/// The recording without its handling; `told` hears of what was left out.
Series without_handling(Series recording, std::vector<std::string>& told);

}  // namespace gyrostat::gap
