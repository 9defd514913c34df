#pragma once

#include <string>

#include <gyrostat/core/series.hpp>

namespace gyrostat::gap {

/// How the gyro takes part in the motion of its reference rate.
struct ReferenceShare {
  double slope = 1.0;   ///< of the gyro over the reference, by least squares
  double motion = 1.0;  ///< standard deviation of the gyro over that of the reference
};

/// 1 and 1 where there is no reference, or one that never changes.
ReferenceShare share_of_reference(const Series& recording);

/// Whether the reference rate is of another axis than the gyro, which turns no more than a
/// misaligned one does: by slope and by deviation less than a tenth of the reference.
bool is_of_another_axis(const ReferenceShare& share);

/// What the share says of how the recording was written, and what to do: radians for degrees, or
/// the other sense of turning; nothing where it says neither.
std::string doubt_of_reference(const ReferenceShare& share);

}  // namespace gyrostat::gap
