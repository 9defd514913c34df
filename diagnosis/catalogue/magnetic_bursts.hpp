#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/magnetic_bursts.hpp>

namespace gyrostat::gap {

/// Stretches of the slow heading that lie six robust deviations away.
template <>
struct Diagnosed<effects::MagneticBursts> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::MagneticBursts::bursts_per_hour,
                                                 &effects::MagneticBursts::mean_duration_s,
                                                 &effects::MagneticBursts::std_deg};

  static std::string why_not_assessable(const Conditions& c) { return needs::heading(c); }

  static bool is_what_it_is_called(const effects::MagneticBursts& effect, const Conditions& /*c*/) {
    return effect.std_deg < 90.0;  // more would turn the compass round
  }
};

}  // namespace gyrostat::gap
