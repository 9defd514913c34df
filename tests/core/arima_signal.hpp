#pragma once

#include <cstdint>
#include <vector>

#include <gyrostat/core/models/arima111.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat {

/// x of `model` from zero, in its white noise; the draws are those of (seed, trial).
inline std::vector<double> arima_signal(const Arima111<double>& model, std::size_t samples,
                                        std::uint64_t seed, std::uint32_t trial = 0) {
  const NormalStream a(seed, trial, "a"), v(seed, trial, "v");
  std::vector<double> z(samples);
  double x = 0.0, difference = 0.0;
  for (std::size_t k = 0; k < samples; ++k) {
    difference = model.phi * difference + model.delta1_dps * a.normal(k + 1) -
                 model.delta2_dps * a.normal(k);
    x += difference;
    z[k] = x + model.measurement_noise_std_dps * v.normal(k);
  }
  return z;
}

/// One step with nothing but the rate.
template <class F>
Step<double> step(F& filter, double z) {
  return filter.step({.gyro_dps = z});
}

}  // namespace gyrostat
