#pragma once

#include <gyrostat/core/models/gain_cycle.hpp>
#include <gyrostat/core/models/model_l.hpp>
#include <gyrostat/core/numerics/scalar_update.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::filters {

/// Kalman filter on the exact state-space form of ARIMA(1,1,1) + white noise, which carries a_k
/// and so keeps the moving-average correlation. With the true parameters it is the minimum-variance
/// estimator of x, and its innovations are the likelihood of the data.
template <class T>
class KfMa {
 public:
  using Scalar = T;
  using Parameters = RandomErrorParameters<T>;
  static constexpr std::string_view title = "Kalman filter that carries a_k (MA-exact)";
  static constexpr Needs needs{};
  static constexpr Role role{};
  static constexpr bool packs_trials = true;

  explicit KfMa(const Parameters& p) : model_(p), state_(ModelExact<T>::initial(p)) {}

  void predict() { model_.predict(state_); }

  /// z in dps, or NaN for a missing sample.
  Step<T> update(const T& z) { return update_first(state_, model_.R, z); }

  Step<T> step(const Sample<T>& sample) {
    predict();
    return update(sample.gyro_dps);
  }

  /// The gains to come, a step by them, and what is left to do after the last one.
  using Cycle = GainCycle<T, 3>;
  Cycle cycle() const { return {model_, state_}; }
  bool step(const Sample<T>& sample, Cycle& cycle, Step<T>& out) {
    return cycle.step(model_, state_.mean, sample.gyro_dps, out);
  }
  void end(const Cycle& cycle) { state_.covariance = cycle.covariance(); }

  const Gaussian<T, 3>& state() const { return state_; }

 private:
  ModelExact<T> model_;
  Gaussian<T, 3> state_;
};

}  // namespace gyrostat::filters
