#pragma once

#include <vector>

#include <gyrostat/core/track.hpp>

namespace gyrostat {

/// Integral of the rate error at every sample, deg, from 0 at the first; a missing gyro value adds
/// nothing.
std::vector<double> heading_errors_deg(const Series& series, const Track& track);

/// The rate error at every sample, missing ones held at the last value (0 before the first), since
/// an Allan deviation needs a value at every sample.
std::vector<double> bridged_rate_errors_dps(const Series& series, const Track& track);

}  // namespace gyrostat
