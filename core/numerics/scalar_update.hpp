#pragma once

#include <gyrostat/core/numerics/kalman.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat {

/// Updates a predicted state with z = x_0 + v, v ~ N(0, r), and reports it as a filter's step. A
/// missing z leaves the prediction; a step that would not be finite leaves it too, and says so.
template <class T, int N>
Step<T> update_first(Gaussian<T, N>& state, const T& r, const T& z) {
  Step<T> step{.status = Status::no_measurement};
  const Mask<T> present = !is_missing(z);
  if (any(present)) {
    Gaussian<T, N> next = state;
    const auto innovation = measure_first(next, r, z);
    const Mask<T> finite = is_sound(next), made = present && innovation.sound && finite;
    state = select(made, next, state);
    step.innovation_dps = select(made, innovation.value(0), step.innovation_dps);
    step.innovation_variance = select(made, innovation.covariance(0), step.innovation_variance);
    set_status(step.status, present, Status::ok);
    set_status(step.status, present && !finite, Status::not_finite);
    set_status(step.status, present && !innovation.sound, Status::indefinite_covariance);
  }
  step.estimate_dps = state.mean(0);
  step.estimate_variance = state.covariance(0, 0);
  return step;
}

}  // namespace gyrostat
