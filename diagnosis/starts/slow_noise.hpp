#pragma once

#include <vector>

#include <gyrostat/diagnosis/evidence.hpp>
#include <gyrostat/diagnosis/gap/allan_components.hpp>
#include <gyrostat/diagnosis/start.hpp>

namespace gyrostat::gap {

/// A slow random effect by the Allan variances, with a random walk beside it and without.
template <class Make>
std::vector<Start> slow_noise(const Evidence& e, SlowComponent component, const Make& make) {
  std::vector<Start> found;
  for (const bool walk : {true, false}) {
    const auto fit = fit_allan_components(e.conditions(), e.scene, component, walk);
    found.push_back({make(fit), {fit.random_error, e.baseline.thermal_drift}});
  }
  return found;
}

/// Slow errors last for more than a few samples.
inline bool is_slow(double correlation_time_s, const Conditions& conditions) {
  return correlation_time_s > 5.0 * conditions.interval_s();
}

}  // namespace gyrostat::gap
