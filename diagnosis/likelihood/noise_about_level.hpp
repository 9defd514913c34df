#pragma once

#include <vector>

#include <gyrostat/diagnosis/likelihood/noise_law.hpp>

namespace gyrostat::gap {

/// Noise about a level that walks, a sample at a time.
struct NoiseAboutLevel {
  std::vector<double>
      coefficients;         ///< of the noise as an autoregression: A(z) = 1 + a_1 / z + ...
  double innovation = 0.0;  ///< variance of what drives it, dps²
  double walk = 0.0;        ///< variance of a step of the level, dps²
};

/// A law but for its rounding: what lasts for less than half of `cluster_s` as an autoregression,
/// the rest as the walk that stands out from it at as fast a frequency.
NoiseAboutLevel noise_about_level(NoiseLaw law, const Angles& angles, double cluster_s);

}  // namespace gyrostat::gap
