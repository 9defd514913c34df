#pragma once

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// Whether most of what varies in something recorded beside the gyro (the rate of another axis, the
/// acceleration, the temperature), or in its square, is a sine of this frequency: the motion or the
/// warming then makes the gyro's, by an effect that is not a line. Lines of 1 Hz and more are
/// shaking, which other channels show as well, and never meant.
bool is_line_beside(const Conditions& conditions, double frequency_hz);

}  // namespace gyrostat::gap
