#pragma once

#include <gyrostat/core/models/coefficient_kalman.hpp>
#include <gyrostat/core/models/thermal_compensator.hpp>

namespace gyrostat::filters {

template <class T>
class KfRule {
 public:
  using Parameters = CoefficientKalmanParameters<T>;
  static constexpr std::string_view title = "thermal drift by a Kalman filter on [a, b, c]";
  static constexpr Role role{.corrects = Role::Corrects::thermal_drift, .published = 2};

  explicit KfRule(const Parameters& p) : kalman_(p) {}

  std::optional<Innovation<T, 3>> update(const BiasEpoch<T>& epoch) {
    const bool measured = kalman_.shift_in(epoch);
    kalman_.walk(T(1.0));
    if (!measured) return std::nullopt;
    return kalman_.update();
  }

  const Coefficients<T>& coefficients() const { return kalman_.coefficients(); }

 private:
  CoefficientKalman<T> kalman_;
};

/// Kalman filter on the thermal coefficients [B], the strong tracking filter with factor 1.
template <class T>
using ThermalKf = ThermalCompensator<T, KfRule<T>>;

}  // namespace gyrostat::filters
