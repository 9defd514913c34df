#pragma once

#include <gyrostat/core/filters/kf_ma.hpp>

namespace gyrostat::filters {

/// The bound from below: knows the motion and the thermal drift, and estimates what is left, x, by
/// the optimal filter. With the true parameters no causal method has a smaller error variance.
template <class T>
class Oracle {
 public:
  using Scalar = T;
  using Parameters = RandomErrorParameters<T>;
  static constexpr std::string_view title = "oracle: true drift and motion, KfMa for the rest";
  static constexpr Needs needs{.truth = true};
  static constexpr Role role{.rank = Role::Rank::bound};
  static constexpr bool packs_trials = true;

  explicit Oracle(const Parameters& p) : random_error_(p) {}

  Step<T> step(Sample<T> sample) {
    const T drift = sample.true_drift_dps;
    sample.gyro_dps -= sample.true_rate_dps + drift;
    Step<T> step = random_error_.step(sample);
    step.estimate_dps += drift;
    return step;
  }

  using Cycle = typename KfMa<T>::Cycle;
  Cycle cycle() const { return random_error_.cycle(); }
  bool step(Sample<T> sample, Cycle& cycle, Step<T>& out) {
    const T drift = sample.true_drift_dps;
    sample.gyro_dps -= sample.true_rate_dps + drift;
    if (!random_error_.step(sample, cycle, out)) return false;
    out.estimate_dps += drift;
    return true;
  }
  void end(const Cycle& cycle) { random_error_.end(cycle); }

 private:
  KfMa<T> random_error_;
};

}  // namespace gyrostat::filters
