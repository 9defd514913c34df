#pragma once

#include <gyrostat/core/models/nl_unscented.hpp>

namespace gyrostat::filters {

/// Square-root unscented Kalman filter on model NL, method 2 of [A]. phi is estimated online;
/// delta1 and delta2 have no cross-covariance with z under symmetric sigma points and stay put.
template <class T>
class SrUkf {
 public:
  using Scalar = T;
  using Parameters = NlParameters<T>;
  static constexpr std::string_view title = "square-root unscented Kalman filter on model NL";
  static constexpr Needs needs{};
  static constexpr Role role{.published = 3};
  static constexpr bool packs_trials = true;

  explicit SrUkf(const Parameters& p) : filter_(p) {}

  Step<T> step(const Sample<T>& sample) { return nl_cycle<T>(filter_, sample.gyro_dps); }

  const NlUnscented<T>& state() const { return filter_; }
  Learned<T> learned() const { return filter_.learned(); }

 private:
  NlUnscented<T> filter_;
};

}  // namespace gyrostat::filters
