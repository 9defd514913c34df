#pragma once

#include <gyrostat/core/models/nl_unscented.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat::filters {

template <class T>
struct SrRsukfScalarParameters : NlParameters<T> {
  T mu_scalar{0.02};

  static constexpr auto fields() {
    using P = SrRsukfScalarParameters;
    return join_fields<P, T>(
        NlParameters<T>::fields(),
        std::array{Field{"mu_scalar", &P::mu_scalar, "1", ranges::non_negative,
                         "risk parameter of every state, in its own units (1/dps² or 1)"}});
  }
};

/// Square-root risk-sensitive unscented Kalman filter with one scalar risk parameter (reference [7]
/// of [A]; Bhaumik, Sadhu and Ghoshal 2009) on model NL: SrRsukf with mu = mu_scalar I.
///
/// One scalar over states of different units is a choice of units: at a value that phi and the
/// noise feel (mu < 1/2, since a has variance 1) it is nothing to x, delta1 and delta2 in dps, and
/// in degrees an hour it would be too much for them. It is left so, in dps, as the reference has
/// it: in units of the initial deviations the unobserved delta1 and delta2 would break down after
/// 1 / (2 mu) steps.
template <class T>
class SrRsukfScalar {
 public:
  using Scalar = T;
  using Parameters = SrRsukfScalarParameters<T>;
  static constexpr std::string_view title =
      "square-root risk-sensitive unscented Kalman filter with scalar risk on model NL";
  static constexpr Needs needs{};
  static constexpr Role role{};
  static constexpr bool packs_trials = true;

  explicit SrRsukfScalar(const Parameters& p)
      : filter_(p), risk_(Vector<T, 7>::Constant(p.mu_scalar)) {}

  Step<T> step(const Sample<T>& sample) { return nl_cycle<T>(filter_, sample.gyro_dps, &risk_); }

  const NlUnscented<T>& state() const { return filter_; }
  Learned<T> learned() const { return filter_.learned(); }

 private:
  NlUnscented<T> filter_;
  NlRisk<T> risk_;
};

}  // namespace gyrostat::filters
