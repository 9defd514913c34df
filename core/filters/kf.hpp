#pragma once

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

  void predict() {
    propagate_companion(state_, model_.first);
    state_.covariance(0, 0) += model_.q;
  }

  /// z in dps, or NaN for a missing sample.
  Step<T> update(const T& z) { return update_first(state_, model_.R, z); }

  Step<T> step(const Sample<T>& sample) {
    predict();
    return update(sample.gyro_dps);
  }

  const Gaussian<T, 2>& state() const { return state_; }

 private:
  ModelL<T> model_;
  Gaussian<T, 2> state_;
};

}  // namespace gyrostat::filters
