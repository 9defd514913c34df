#pragma once

#include <algorithm>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/motion.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/dead_zone.hpp>

namespace gyrostat::gap {

/// Small rates are lost, with or without their share of larger ones, at a threshold or about it.
template <>
struct Diagnosed<effects::DeadZone> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::DeadZone::half_width_dps,
                                                 &effects::DeadZone::lost_beyond,
                                                 &effects::DeadZone::dither};

  static std::size_t chosen_parameters(const effects::DeadZone& effect) {
    return effect.dither != 0.0 ? 1 : 0;
  }

  static std::vector<effects::DeadZone> starts(const Evidence& e) {
    // That of a play adds up far below the noise, by the direction of the rate.
    const double narrowest_dps = std::min(0.001 * fastest_dps(e.conditions()),
                                          0.01 * e.baseline.random_error.measurement_noise_std_dps);
    std::vector<effects::DeadZone> found;
    for (const double dither : {0.0, 0.3})
      for (const double lost : {0.0, 1.0})
        found.push_back(shaped(e, Trace::rate,
                               effects::DeadZone{.lost_beyond = lost, .dither = dither},
                               &effects::DeadZone::half_width_dps, narrowest_dps,
                               most_of_motion * fastest_dps(e.conditions())));
    return found;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  static bool is_what_it_is_called(const effects::DeadZone& effect, const Conditions& c) {
    return effect.half_width_dps <= most_of_motion * fastest_dps(c);
  }

 private:
  /// Else the zone is not about rest.
  static constexpr double most_of_motion = 0.5;
};

}  // namespace gyrostat::gap
