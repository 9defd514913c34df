#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/scale_factor.hpp>
#include <gyrostat/generators/effects/scale_temperature.hpp>

namespace gyrostat::gap {

/// A share of the rate that changes with temperature, evenly or not, and is right at some
/// temperature that was met, or at that of a room, where sensors are calibrated: one that is right
/// at none is another scale factor besides.
template <>
struct Diagnosed<effects::ScaleTemperature> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::ScaleTemperature::scale_per_C,
                                                 &effects::ScaleTemperature::curvature_per_C2,
                                                 &effects::ScaleTemperature::reference_C};

  static std::vector<effects::ScaleTemperature> starts(const Evidence& e) {
    const auto& T = e.conditions().slow_temperature_C();
    const auto [low, high] = std::ranges::minmax(T);
    const double middle = 0.5 * (low + high);
    const auto [coldest, warmest] = may_be_right(e.conditions());
    const auto sizes = [&](const std::vector<Effect>& parts) {
      return match(signatures(e, Trace::rate, parts), trace_of(e, Trace::rate)).amplitudes;
    };
    const effects::ScaleTemperature even{1.0, middle}, curved{0.0, middle, 1.0};
    const auto both = sizes({even, curved}), shifted = sizes({even, effects::ScaleFactor{1.0}});
    const double right_C = middle - shifted[1] / shifted[0];
    return {{sizes({even})[0], middle},
            {both[0], middle, both[1]},
            {shifted[0], std::isfinite(right_C) ? std::clamp(right_C, coldest, warmest) : middle}};
  }

  static std::string why_not_assessable(const Conditions& c) {
    if (auto why = needs::motion(c); !why.empty()) return why;
    const auto why = needs::warming(c);
    return why.empty() ? why : why + ": turn the sensor while it warms";
  }

  static bool is_what_it_is_called(const effects::ScaleTemperature& effect, const Conditions& c) {
    const auto [coldest, warmest] = may_be_right(c);
    return coldest <= effect.reference_C && effect.reference_C <= warmest;
  }

 private:
  static std::pair<double, double> may_be_right(const Conditions& c) {
    constexpr double coldest_room_C = 20.0, warmest_room_C = 25.0;
    const auto [low, high] = std::ranges::minmax(c.slow_temperature_C());
    // Far from what was met it would be the same as a scale factor.
    const double furthest_C = 0.5 * (high - low);
    const double coldest = std::max(coldest_room_C, low - furthest_C),
                 warmest = std::min(warmest_room_C, high + furthest_C);
    return {coldest <= warmest_room_C ? std::min(low, coldest) : low,
            warmest >= coldest_room_C ? std::max(high, warmest) : high};
  }
};

}  // namespace gyrostat::gap
