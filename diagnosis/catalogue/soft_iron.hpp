#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/iron.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/soft_iron.hpp>

namespace gyrostat::gap {

/// Two periods a turn.
template <>
struct Diagnosed<effects::SoftIron> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::SoftIron::amplitude_deg,
                                                 &effects::SoftIron::phase_deg};

  static std::vector<effects::SoftIron> starts(const Evidence& e) {
    return irons<effects::SoftIron>(e);
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::turns(c); }

  static bool is_what_it_is_called(const effects::SoftIron& /*effect*/, const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
