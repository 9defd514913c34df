#pragma once

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// Slow errors last for longer than what an output filter makes of white noise.
inline bool is_slow(double correlation_time_s, const Conditions& conditions) {
  constexpr double samples = 30.0;
  return correlation_time_s > samples * conditions.interval_s();
}

}  // namespace gyrostat::gap
