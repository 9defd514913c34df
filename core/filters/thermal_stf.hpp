#pragma once

#include <gyrostat/core/models/coefficient_kalman.hpp>
#include <gyrostat/core/models/fading.hpp>
#include <gyrostat/core/models/thermal_compensator.hpp>

namespace gyrostat::filters {

template <class T>
struct ThermalStfParameters : CoefficientKalmanParameters<T>, FadingParameters<T> {
  static constexpr auto fields() {
    return join_fields<ThermalStfParameters, T>(CoefficientKalmanParameters<T>::fields(),
                                                FadingParameters<T>::fields());
  }
};

template <class T>
class StfRule {
 public:
  using Parameters = ThermalStfParameters<T>;
  static constexpr std::string_view title =
      "thermal drift by a strong tracking Kalman filter on [a, b, c]";
  static constexpr Role role{.corrects = Role::Corrects::thermal_drift, .published = 4};

  explicit StfRule(const Parameters& p) : kalman_(p), fading_(p) {}

  /// Fades only where there is a measurement: a disturbed compass must not inflate P without end.
  std::optional<Innovation<T, 3>> update(const BiasEpoch<T>& epoch) {
    if (!kalman_.shift_in(epoch)) {
      kalman_.walk(T(1.0));
      return std::nullopt;
    }
    kalman_.walk(fading_.next(kalman_.innovation().squaredNorm(), kalman_.process_trace(),
                              kalman_.measurement_trace(), kalman_.predicted_trace()));
    return kalman_.update();
  }

  const Coefficients<T>& coefficients() const { return kalman_.coefficients(); }

 private:
  CoefficientKalman<T> kalman_;
  FadingFactor<T> fading_;
};

/// Strong tracking Kalman filter on the thermal coefficients [B eq. 6]; the factor s, which [B]
/// leaves open, is fixed or adaptive.
template <class T>
using ThermalStf = ThermalCompensator<T, StfRule<T>>;

}  // namespace gyrostat::filters
