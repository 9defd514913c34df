#pragma once

#include <algorithm>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/motion.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/dead_zone.hpp>

namespace gyrostat::gap {

/// Small rates are lost, with or without their share of larger ones.
template <>
struct Diagnosed<effects::DeadZone> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::DeadZone::half_width_dps,
                                                 &effects::DeadZone::lost_beyond};

  static std::vector<effects::DeadZone> starts(const Evidence& e) {
    // Narrower than the noise it does not show.
    const double narrowest_dps =
        std::min(0.001 * fastest_dps(e), e.baseline.random_error.measurement_noise_std_dps);
    std::vector<effects::DeadZone> found;
    for (const double lost : {0.0, 1.0})
      found.push_back(shaped(e, Trace::rate, effects::DeadZone{.lost_beyond = lost},
                             &effects::DeadZone::half_width_dps, narrowest_dps,
                             0.5 * fastest_dps(e)));
    return found;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  static bool is_what_it_is_called(const effects::DeadZone& /*effect*/, const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
