#pragma once

#include <cstddef>

#include <gyrostat/diagnosis/likelihood/noise_law.hpp>

namespace gyrostat::gap {

/// Allan variance, dps², of what a law says, at means of `cluster` >= 1 samples: of a stationary
/// part with the autocovariance c by
///   sigma²(m) = (m c(0) + sum over the lags k < 2 m of w(k) c(k)) / m²,
///   w(k) = 2 m - 3 k for k < m, k - 2 m from there on,
/// which is half the mean square difference of neighbouring means (IEEE Std 952 annex C) written
/// out; of filtered white noise by its spectrum; of a random walk in closed form. Jumps count by
/// their covariance. In O(cluster).
double allan_variance(const NoiseLaw& law, std::size_t cluster);

}  // namespace gyrostat::gap
