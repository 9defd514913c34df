#pragma once

#include <cstdint>
#include <vector>

#include <gyrostat/generators/random_error.hpp>

namespace gyrostat {

/// Random error and white noise of a model at the address (seed, trial).
inline std::vector<double> simulated(const Arima111<double>& model, std::size_t samples,
                                     const Noise& noise) {
  std::vector<double> z(samples);
  add_random_error(model, noise, z);
  add_white_noise(model.measurement_noise_std_dps, noise.stream("white_noise"), z);
  return z;
}

}  // namespace gyrostat
