#pragma once

#include <algorithm>
#include <numeric>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/remedies.hpp>
#include <gyrostat/generators/effects/scale_temperature.hpp>

namespace gyrostat::gap {

/// A share of the rate that changes with temperature, evenly or not, about the middle of its range:
/// with another middle the scale factor would be another.
template <>
struct Diagnosed<effects::ScaleTemperature> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::ScaleTemperature::scale_per_C,
                                                 &effects::ScaleTemperature::curvature_per_C2};

  static std::vector<effects::ScaleTemperature> starts(const Evidence& e) {
    const auto& T = e.conditions().slow_temperature_C();
    const double middle = 0.5 * (std::ranges::min(T) + std::ranges::max(T));
    const auto both = match(signatures(e, Trace::rate,
                                       {effects::ScaleTemperature{1.0, middle},
                                        effects::ScaleTemperature{0.0, middle, 1.0}}),
                            trace_of(e, Trace::rate))
                          .amplitudes;
    return {scaled(e, Trace::rate, effects::ScaleTemperature{1.0, middle},
                   [](auto& p, double a) { p.scale_per_C = a; }),
            {both[0], middle, both[1]}};
  }

  /// Right at the temperature of data sheets, or at the recording's mean.
  static std::vector<effects::ScaleTemperature> told_otherwise(
      const effects::ScaleTemperature& effect, const Conditions& c) {
    const auto& T = c.slow_temperature_C();
    const double mean_C = std::accumulate(T.begin(), T.end(), 0.0) / static_cast<double>(T.size());
    return {{effect.scale_per_C, 25.0, effect.curvature_per_C2},
            {effect.scale_per_C, mean_C, effect.curvature_per_C2}};
  }

  static std::string why_not_assessable(const Conditions& c) {
    if (auto why = needs::told_motion(c); !why.empty()) return why;
    const auto why = needs::warming(c);
    return why.empty() ? why : why + ": turn the sensor while it warms";
  }

  static bool is_what_it_is_called(const effects::ScaleTemperature& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
