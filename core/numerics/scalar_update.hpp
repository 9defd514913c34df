#pragma once

#include "core/numerics/kalman.hpp"
#include "core/step.hpp"

namespace gyrostat {

/// Updates a predicted state with z = x_0 + v, v ~ N(0, r), and reports it as a filter's step. A
/// missing z leaves the prediction; a step that would not be finite leaves it too, and says so.
template <class T, int N>
Step<T> update_first(Gaussian<T, N>& state, const T& r, const T& z) {
  Step<T> step{.estimate_dps = state.mean(0),
               .estimate_variance = state.covariance(0, 0),
               .status = Status::no_measurement};
  if (is_missing(z)) return step;
  Gaussian<T, N> next = state;
  const auto innovation = measure_first(next, r, z);
  if (!innovation.sound || !is_sound(next)) {
    step.status = innovation.sound ? Status::not_finite : Status::indefinite_covariance;
    return step;
  }
  state = next;
  return {.estimate_dps = state.mean(0),
          .estimate_variance = state.covariance(0, 0),
          .innovation_dps = innovation.value(0),
          .innovation_variance = innovation.covariance(0)};
}

}  // namespace gyrostat
