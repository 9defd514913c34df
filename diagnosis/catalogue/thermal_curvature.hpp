#pragma once

#include <algorithm>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/thermal_curvature.hpp>

namespace gyrostat::gap {

/// The square of the temperature, or with its cube, about the middle of its range: with another
/// middle the linear drift would be another. Or a kink.
template <>
struct Diagnosed<effects::ThermalCurvature> {
  static constexpr auto signature = Signature::slow;
  static constexpr std::array free_parameters = {&effects::ThermalCurvature::curvature_dps_per_C2,
                                                 &effects::ThermalCurvature::cubic_dps_per_C3,
                                                 &effects::ThermalCurvature::kink_dps_per_C,
                                                 &effects::ThermalCurvature::kink_C};
  static constexpr std::size_t amplitudes = 3;

  static std::vector<effects::ThermalCurvature> guesses(const Beside& beside) {
    const double middle_C = beside.middle_temperature_C();
    std::vector<effects::ThermalCurvature> all = {{1.0, middle_C}, {1.0, middle_C, 1.0}};
    const double span_C = extent(beside.conditions.slow_temperature_C());
    for (const double off : {-0.4, -0.2, 0.0, 0.2, 0.4})
      all.push_back({.curvature_dps_per_C2 = 0.0,
                     .reference_C = middle_C,
                     .kink_dps_per_C = 1.0,
                     .kink_C = middle_C + off * span_C});
    return all;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::warming(c); }

  /// Beyond a kink there is a slope on either side.
  static bool is_what_it_is_called(const effects::ThermalCurvature& effect, const Conditions& c) {
    if (effect.kink_dps_per_C == 0.0) return true;
    const auto& T = c.slow_temperature_C();
    const auto [low, high] = std::minmax_element(T.begin(), T.end());
    const double at = (effect.kink_C - *low) / (*high - *low);
    constexpr double edge = 0.08;
    return at > edge && at < 1.0 - edge;
  }
};

}  // namespace gyrostat::gap
