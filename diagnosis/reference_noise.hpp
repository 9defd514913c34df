#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/series.hpp>

namespace gyrostat::gap {

/// Standard deviation of the white noise of the reference rate that the gyro does not follow, from
/// where it is quietest: 0 where there is none, or what is there may be motion (its
/// differences are not those of white noise, or the gyro has a part of them).
double reference_noise_dps(const Series& recording);

/// A signal in white noise of this standard deviation, by parabolas over the longest span about
/// each sample at which all shorter ones agree with it: the adaptive order-two local polynomial of
/// Katkovnik ("A new method for varying adaptive bandwidth selection", IEEE Trans. Signal Process.
/// 47, 1999), without the sample itself, so that where the smooth signal is high its noise is not.
/// Jumps stay where they are.
std::vector<double> without_white_noise(const std::vector<double>& values, double std);

/// The recording with a reference without that noise: against a noisy one, a gyro at rest does not
/// follow what small rates there are, as one with a dead zone, or what is fast, as a slow one. The
/// gyro has the noise instead, so that its error is what it was and white, unless its values are
/// there for what they are (a grid, repeats, a limit). `told` hears of it.
Series without_reference_noise(Series recording, std::vector<std::string>& told);

}  // namespace gyrostat::gap
