#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/generators/effects/thermal_lag.hpp>

namespace gyrostat::gap {

/// The slow rate follows the temperature late.
template <>
struct Diagnosed<effects::ThermalLag> {
  static constexpr auto signature = Signature::slow;
  static constexpr std::array free_parameters = {&effects::ThermalLag::sensitivity_dps_per_C,
                                                 &effects::ThermalLag::time_constant_s};

  static std::vector<Start> starts(const Evidence& e) {
    const auto& c = e.conditions();
    return cleaned(e, scaled_over(e, Trace::slow_rate, effects::ThermalLag{},
                                  &effects::ThermalLag::time_constant_s, 2.0 * c.slow_interval_s(),
                                  0.5 * c.slow_interval_s() * static_cast<double>(c.slow_size()),
                                  [](auto& p, double a) { p.sensitivity_dps_per_C = a; }));
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::warming(c); }

  static bool is_what_it_is_called(const effects::ThermalLag& /*effect*/, const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
