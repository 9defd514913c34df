#pragma once

#include <gyrostat/core/models/gain_cycle.hpp>
#include <gyrostat/core/models/model_l.hpp>
#include <gyrostat/core/numerics/scalar_update.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::filters {

/// Kalman filter on model L [A]. Treats a_{k-1} as fresh noise, so it is not the optimal filter
/// even with the true parameters: see KfMa.
template <class T>
class Kf {
 public:
  using Scalar = T;
  using Parameters = RandomErrorParameters<T>;
  static constexpr std::string_view title = "Kalman filter on model L";
  static constexpr Needs needs{};
  static constexpr Role role{.published = 1};
  static constexpr bool packs_trials = true;

  explicit Kf(const Parameters& p) : model_(p), state_(ModelL<T>::initial(p)) {}

  void predict() { model_.predict(state_); }

  /// z in dps, or NaN for a missing sample.
  Step<T> update(const T& z) { return update_first(state_, model_.R, z); }

  Step<T> step(const Sample<T>& sample) {
    predict();
    return update(sample.gyro_dps);
  }

  /// The gains to come, a step by them, and what is left to do after the last one.
  using Cycle = GainCycle<T, 2>;
  Cycle cycle() const { return {model_, state_}; }
  bool step(const Sample<T>& sample, Cycle& cycle, Step<T>& out) {
    return cycle.step(model_, state_.mean, sample.gyro_dps, out);
  }
  void end(const Cycle& cycle) { state_.covariance = cycle.covariance(); }

  const Gaussian<T, 2>& state() const { return state_; }

 private:
  ModelL<T> model_;
  Gaussian<T, 2> state_;
};

}  // namespace gyrostat::filters
