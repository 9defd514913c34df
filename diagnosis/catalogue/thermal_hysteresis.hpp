#pragma once

#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/thermal_hysteresis.hpp>

namespace gyrostat::gap {

/// The branches of rising and falling temperature lie apart: both must have been seen.
template <>
struct Diagnosed<effects::ThermalHysteresis> {
  static constexpr auto signature = Signature::slow;
  static constexpr std::array free_parameters = {
      &effects::ThermalHysteresis::amplitude_dps,
      &effects::ThermalHysteresis::of_three_quarters_dps, &effects::ThermalHysteresis::of_half_dps,
      &effects::ThermalHysteresis::of_quarter_dps, &effects::ThermalHysteresis::width_C};
  static constexpr std::size_t amplitudes = 4;

  /// No sensor knows at once that its temperature has turned.
  static std::size_t chosen_parameters(const effects::ThermalHysteresis& effect) {
    return (effect.gradual != 0.0 ? 1 : 0) + (effect.sudden != 0.0 ? 3 : 0) +
           (effect.first_branch != 0.0 ? 1 : 0);
  }

  static std::vector<effects::ThermalHysteresis> guesses(const Beside& beside) {
    std::vector<effects::ThermalHysteresis> all;
    const double span_C = extent(beside.conditions.slow_temperature_C());
    for (const double first : {0.0, 1.0, -1.0})
      for (const double gradual : {0.0, 1.0})
        for (const double share : {0.003, 0.01, 0.03, 0.08, 0.2, 0.4})
          all.push_back({1.0, share * span_C, gradual, first});
    for (const double first : {0.0, 1.0, -1.0})
      for (const double share : {0.1, 0.2, 0.4})
        all.push_back({1.0, share * span_C, 0.0, first, 1.0, 1.0, 1.0});
    for (const double share : {0.02, 0.1})
      all.push_back({.amplitude_dps = 1.0, .width_C = share * span_C, .sudden = 1.0});
    return all;
  }

  static std::string why_not_assessable(const Conditions& c) {
    if (auto why = needs::warming(c); !why.empty()) return why;
    const auto& T = c.slow_temperature_C();
    double rise = 0.0, fall = 0.0, low = T.front(), high = T.front();
    for (const double t : T) {
      low = std::min(low, t);
      high = std::max(high, t);
      rise = std::max(rise, t - low);
      fall = std::max(fall, high - t);
    }
    if (std::min(rise, fall) >= needs::least_warming_C) return {};
    return fmt::format(
        "the temperature rises by {:.2g} °C and falls by {:.2g} °C; {:g} °C each way are needed",
        rise, fall, needs::least_warming_C);
  }

  /// Of what has not come near the other branch, nothing says that there is one.
  static bool is_what_it_is_called(const effects::ThermalHysteresis& effect, const Conditions& c) {
    const auto& T = c.slow_temperature_C();
    const auto [low, high] = std::minmax_element(T.begin(), T.end());
    return effect.width_C <= *high - *low;
  }
};

}  // namespace gyrostat::gap
