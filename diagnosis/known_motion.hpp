#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/series.hpp>

namespace gyrostat::gap {

/// How many samples the gyro shows the reference's rate later than the reference does (below 0:
/// earlier): whole samples by their correlation, up to a twentieth of the recording, parts of one
/// by least squares with a scale and a level. 0 where they do not go together.
double lateness_samples(const Series& recording);

/// The recording without what its gyro shows of a motion before the reference begins, or after it
/// ends: where it is late or early, and the reference moves by more than the noise meanwhile, these
/// samples are missing. `told` hears of it.
Series with_known_motion(Series recording, std::vector<std::string>& told);

}  // namespace gyrostat::gap
