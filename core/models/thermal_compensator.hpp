#pragma once

#include <gyrostat/core/models/compass_aiding.hpp>
#include <gyrostat/core/models/thermal.hpp>

namespace gyrostat {

/// A thermal method as a filter: compass aiding makes epochs, `Rule` learns the coefficients from
/// them, and the bias B = a T + b T' + c of the last epoch is held until the next.
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

  explicit ThermalCompensator(const Parameters& p) : aiding_(p.update_interval_s), rule_(p) {}

  Step<T> step(const Sample<T>& sample) {
    Step<T> step;
    step.status = Status::no_measurement;
    if (const auto epoch = aiding_.observe(sample, held_.estimate_dps)) {
      if (started_) learn(*epoch, step);
      started_ = true;
      hold(*epoch, step);
    }
    step.estimate_dps = held_.estimate_dps;
    step.estimate_variance = held_.estimate_variance;
    return step;
  }

  const Rule& rule() const { return rule_; }

 private:
  void learn(const BiasEpoch<T>& epoch, Step<T>& step) {
    Rule next = rule_;
    const auto innovation = next.update(epoch);
    if (innovation && !innovation->sound) {
      step.status = Status::indefinite_covariance;
      return;
    }
    if (!is_sound(next.coefficients()) || (innovation && !is_positive(innovation->covariance(0)))) {
      step.status = Status::not_finite;
      return;
    }
    rule_ = next;
    if (!innovation) return;
    step.status = Status::ok;
    step.innovation_dps = innovation->value(0);
    step.innovation_variance = innovation->covariance(0);
  }

  static bool is_positive(const T& variance) {
    using std::isfinite;
    return isfinite(variance) && variance > T(0.0);
  }

  void hold(const BiasEpoch<T>& epoch, Step<T>& step) {
    using std::isfinite;
    const auto& [mean, covariance] = rule_.coefficients();
    const T bias = epoch.regressors.dot(mean);
    const T variance = epoch.regressors.dot(covariance * epoch.regressors);
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
  bool started_ = false;
};

}  // namespace gyrostat
