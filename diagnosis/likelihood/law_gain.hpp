#pragma once

#include <gyrostat/diagnosis/likelihood/noise_law.hpp>

namespace gyrostat::gap {

/// Of a log-likelihood ratio over recordings.
struct Gain {
  double mean, deviation;  ///< nats
};

/// What `samples` values of the law `truth` say for it against `rival` with the white noise and the
/// walk under which they are likeliest: Whittle's likelihood, in which ordinates of a periodogram
/// are independent and exponential. They are looked at as on `grid`, and below its fast frequencies
/// at their own; the lowest `lost` do not count.
Gain gain_over(const NoiseLaw& truth, const NoiseLaw& rival, const RateGrid& grid, double samples,
               double lost);

}  // namespace gyrostat::gap
