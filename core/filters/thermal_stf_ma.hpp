#pragma once

#include <gyrostat/core/models/coefficient_kalman_ma.hpp>
#include <gyrostat/core/models/thermal_compensator.hpp>

namespace gyrostat::filters {

template <class T>
class StfMaRule {
 public:
  using Parameters = CoefficientKalmanMaParameters<T>;
  static constexpr std::string_view title =
      "thermal drift by a strong tracking Kalman filter that knows the compass noise is shared";
  static constexpr Role role{.corrects = Role::Corrects::thermal_drift};

  explicit StfMaRule(const Parameters& p) : kalman_(p) {}

  std::optional<Innovation<T, 1>> update(const BiasEpoch<T>& epoch) {
    return kalman_.update(epoch);
  }
  Coefficients<T> coefficients() const { return kalman_.coefficients(); }

 private:
  CoefficientKalmanMa<T> kalman_;
};

/// ThermalStf with the error of M modelled: each M is used once and carries the compass noise that
/// it shares with its neighbours, where [B eq. 3-4] uses it three times as if it were white.
template <class T>
using ThermalStfMa = ThermalCompensator<T, StfMaRule<T>>;

}  // namespace gyrostat::filters
