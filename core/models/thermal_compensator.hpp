#pragma once

#include <gyrostat/core/models/compass_aiding.hpp>
#include <gyrostat/core/models/thermal.hpp>

namespace gyrostat {

/// A thermal method as a filter: compass aiding makes epochs, `Rule` learns the coefficients from
/// them, and the bias is B = a T + b T' + c. [B] updates parameters every 10 s and leaves open what
/// the bias does meanwhile, and under interference; both readings of both are here:
///   between updates  B of the last epoch is held, or follows T (with T' of the last interval);
///   without a compass  the coefficients last learnt go on with T and T' ("coasts"), or the bias
///                      last learnt stays, [B]'s "parameters remain at the previous estimated error
///                      value", until a rule has learnt again.
///
/// A rule has `coefficients()` and `update(epoch)`, which is called at every epoch after the first
/// and returns the innovation of the newest bias measurement where it used it.
template <class T, class Rule>
class ThermalCompensator {
 public:
  using Scalar = T;
  using Parameters = typename Rule::Parameters;
  static constexpr std::string_view title = Rule::title;
  static constexpr Needs needs{.temperature = true, .heading = true};
  static constexpr Role role = Rule::role;

  explicit ThermalCompensator(const Parameters& p)
      : aiding_(p.update_interval_s),
        rule_(p),
        follows_(p.follows_temperature != T(0.0)),
        keeps_(p.keeps_bias != T(0.0)) {}

  Step<T> step(const Sample<T>& sample) {
    Step<T> step;
    step.status = Status::no_measurement;
    if (const auto epoch = aiding_.observe(sample, at_epoch_dps_)) {
      const bool learnt = started_ ? learn(*epoch, step) : true;
      started_ = true;
      kept_ = keeps_ && !learnt;
      regressors_ = epoch->regressors;
      if (!kept_) hold(step);
      at_epoch_dps_ = held_.estimate_dps;
    } else if (follows_ && started_ && !kept_ && !is_missing(sample.temperature_C)) {
      regressors_(0) = sample.temperature_C;
      hold(step);
    }
    step.estimate_dps = held_.estimate_dps;
    step.estimate_variance = held_.estimate_variance;
    return step;
  }

  const Rule& rule() const { return rule_; }

  /// None where samples between epochs do more than hold.
  std::optional<HeldInterval<T>> held() const {
    if (follows_) return std::nullopt;
    auto held = aiding_.held();
    held.compensated_dps = at_epoch_dps_;
    held.estimate_dps = held_.estimate_dps;
    held.estimate_variance = held_.estimate_variance;
    return held;
  }
  void resume(const HeldInterval<T>& held) { aiding_.resume(held); }

 private:
  /// Whether the rule learnt from the epoch.
  bool learn(const BiasEpoch<T>& epoch, Step<T>& step) {
    Rule next = rule_;
    const auto innovation = next.update(epoch);
    if (innovation && !innovation->sound) {
      step.status = Status::indefinite_covariance;
      return false;
    }
    if (!is_sound(next.coefficients()) || (innovation && !is_positive(innovation->covariance(0)))) {
      step.status = Status::not_finite;
      return false;
    }
    rule_ = next;
    if (!innovation) return false;
    step.status = Status::ok;
    step.innovation_dps = innovation->value(0);
    step.innovation_variance = innovation->covariance(0);
    return true;
  }

  static bool is_positive(const T& variance) {
    using std::isfinite;
    return isfinite(variance) && variance > T(0.0);
  }

  void hold(Step<T>& step) {
    using std::isfinite;
    const auto& [mean, covariance] = rule_.coefficients();
    const T bias = regressors_.dot(mean);
    const T variance = regressors_.dot(covariance * regressors_);
    if (isfinite(bias) && isfinite(variance) && variance > T(0.0)) {
      held_.estimate_dps = bias;
      held_.estimate_variance = variance;
    } else {
      step.status = Status::not_finite;
    }
  }

  CompassAiding<T> aiding_;
  Rule rule_;
  Step<T> held_;
  Vector<T, 3> regressors_ = Vector<T, 3>::Zero();
  T at_epoch_dps_{0.0};  ///< what the aiding compensates by over an interval
  bool follows_, keeps_;
  bool started_ = false;
  bool kept_ = false;  ///< the last bias stays, for want of a compass
};

}  // namespace gyrostat
