#pragma once

#include <gyrostat/core/models/thermal_compensator.hpp>

namespace gyrostat::filters {

template <class T>
class MlrRule {
 public:
  using Parameters = ThermalParameters<T>;
  static constexpr std::string_view title = "thermal drift by multiple linear regression, constant";
  static constexpr Role role{.corrects = Role::Corrects::thermal_drift, .published = 1};

  explicit MlrRule(const Parameters& p)
      : coefficients_{p.coefficients(), p.initial_covariance()},
        measurement_variance_(p.bias_measurement_std_dps * p.bias_measurement_std_dps) {}

  /// Learns nothing; reports how the constant coefficients predict the measured bias.
  std::optional<Innovation<T, 1>> update(const BiasEpoch<T>& epoch) const {
    if (!epoch.is_valid()) return std::nullopt;
    const auto& h = epoch.regressors;
    Innovation<T, 1> innovation;
    innovation.sound = true;
    innovation.value(0) = epoch.bias_dps - h.dot(coefficients_.mean);
    innovation.covariance(0) = measurement_variance_ + h.dot(coefficients_.covariance * h);
    return innovation;
  }

  const Coefficients<T>& coefficients() const { return coefficients_; }

 private:
  Coefficients<T> coefficients_;
  T measurement_variance_;
};

/// Multiple linear regression [B]: the bias on T and T' with coefficients fitted once.
template <class T>
using ThermalMlr = ThermalCompensator<T, MlrRule<T>>;

}  // namespace gyrostat::filters
