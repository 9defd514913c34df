#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/iron.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/hard_iron.hpp>

namespace gyrostat::gap {

/// One period a turn.
template <>
struct Diagnosed<effects::HardIron> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::HardIron::amplitude_deg,
                                                 &effects::HardIron::phase_deg};

  static std::vector<effects::HardIron> starts(const Evidence& e) {
    return irons<effects::HardIron>(e);
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::turns(c); }

  static bool is_what_it_is_called(const effects::HardIron& /*effect*/, const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
