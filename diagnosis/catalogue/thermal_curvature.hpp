#pragma once

#include <algorithm>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/generators/effects/thermal_curvature.hpp>

namespace gyrostat::gap {

/// The square of the temperature, about the middle of its range: with another middle the linear
/// drift would be another.
template <>
struct Diagnosed<effects::ThermalCurvature> {
  static constexpr auto signature = Signature::slow;
  static constexpr std::array free_parameters = {&effects::ThermalCurvature::curvature_dps_per_C2};

  static std::vector<Start> starts(const Evidence& e) {
    const auto& T = e.conditions().slow_temperature_C();
    const double middle =
        0.5 * (*std::min_element(T.begin(), T.end()) + *std::max_element(T.begin(), T.end()));
    return cleaned(e, scaled(e, Trace::slow_rate, effects::ThermalCurvature{1.0, middle},
                             [](auto& p, double a) { p.curvature_dps_per_C2 = a; }));
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::warming(c); }

  static bool is_what_it_is_called(const effects::ThermalCurvature& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
