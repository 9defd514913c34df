#pragma once

#include <gyrostat/core/models/nl_unscented.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat::filters {

/// Random walk of the parameters of model NL, per sample.
template <class T>
struct ParameterWalk {
  T walk_phi_std{0.001};
  T walk_delta1_std_dps{0.0};
  T walk_delta2_std_dps{0.0};

  static constexpr auto fields() {
    using P = ParameterWalk;
    return std::array{
        Field{"walk_phi_std", &P::walk_phi_std, "1", ranges::non_negative,
              "standard deviation of the change of phi between samples"},
        Field{"walk_delta1_std_dps", &P::walk_delta1_std_dps, "dps", ranges::non_negative,
              "standard deviation of the change of delta1 between samples"},
        Field{"walk_delta2_std_dps", &P::walk_delta2_std_dps, "dps", ranges::non_negative,
              "standard deviation of the change of delta2 between samples"},
    };
  }
};

template <class T>
struct SrUkfWalkParameters : NlParameters<T>, ParameterWalk<T> {
  static constexpr auto fields() {
    return join_fields<SrUkfWalkParameters, T>(NlParameters<T>::fields(),
                                               ParameterWalk<T>::fields());
  }
};

/// SrUkf with the process noise on phi, delta1 and delta2 that model NL of [A eq. 5] lacks, so that
/// phi stays open to change. The parameters take their step before the model uses them. No
/// measurement ever informs on delta1 and delta2, so a walk of theirs adds up in their variances,
/// and through them in that of x, for as long as the filter runs: their default is none.
template <class T>
class SrUkfWalk {
 public:
  using Scalar = T;
  using Parameters = SrUkfWalkParameters<T>;
  static constexpr std::string_view title =
      "square-root unscented Kalman filter on model NL with walking parameters";
  static constexpr Needs needs{};
  static constexpr Role role{};
  static constexpr bool packs_trials = true;

  explicit SrUkfWalk(const Parameters& p)
      : filter_(p), walk_std_(p.walk_phi_std, p.walk_delta1_std_dps, p.walk_delta2_std_dps) {}

  Step<T> step(const Sample<T>& sample) {
    filter_.walk_parameters(walk_std_);
    return nl_cycle<T>(filter_, sample.gyro_dps);
  }

  const NlUnscented<T>& state() const { return filter_; }
  Learned<T> learned() const { return filter_.learned(); }

 private:
  NlUnscented<T> filter_;
  Vector<T, 3> walk_std_;
};

}  // namespace gyrostat::filters
