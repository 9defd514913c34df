#pragma once

#include <gyrostat/core/models/fading.hpp>
#include <gyrostat/core/models/model_l.hpp>
#include <gyrostat/core/numerics/scalar_update.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::filters {

template <class T>
struct StfParameters : RandomErrorParameters<T>, FadingParameters<T> {
  static constexpr auto fields() {
    return join_fields<StfParameters, T>(RandomErrorParameters<T>::fields(),
                                         FadingParameters<T>::fields());
  }
};

/// Strong tracking Kalman filter on model L, method 1 of [A]: P- = factor F P F^T + Q, with the
/// factor of Zhou and Frank (1996). With factor 1 it is Kf, bit for bit.
template <class T>
class Stf {
 public:
  using Scalar = T;
  using Parameters = StfParameters<T>;
  static constexpr std::string_view title = "strong tracking Kalman filter on model L";
  static constexpr Needs needs{};
  static constexpr Role role{.published = 2};
  static constexpr bool packs_trials = true;

  explicit Stf(const Parameters& p) : model_(p), fading_(p), state_(ModelL<T>::initial(p)) {}

  /// The process noise follows in `update`, since the fading factor waits for the innovation.
  void predict() { propagate_companion(state_, model_.first); }

  /// z in dps, or NaN for a missing sample, which fades nothing. A measurement too large to fade by
  /// is left out.
  Step<T> update(const T& z) {
    using std::isfinite;
    const T innovation = z - state_.mean(0);
    const T squared = innovation * innovation;
    const Mask<T> present = !is_missing(z), fades = isfinite(squared);
    const T factor = fading_.next(squared, model_.q, model_.R, state_.covariance(0, 0));
    Gaussian<T, 2> faded = state_;
    faded.covariance *= factor;
    faded.covariance(0, 0) += model_.q;
    state_.covariance(0, 0) += model_.q;
    state_ = select(is_sound(faded), faded, state_);
    Step<T> step = update_first(state_, model_.R, select(fades, z, T(no_value)));
    set_status(step.status, present && !fades, Status::not_finite);
    return step;
  }

  Step<T> step(const Sample<T>& sample) {
    predict();
    return update(sample.gyro_dps);
  }

  const Gaussian<T, 2>& state() const { return state_; }

 private:
  ModelL<T> model_;
  FadingFactor<T> fading_;
  Gaussian<T, 2> state_;
};

}  // namespace gyrostat::filters
