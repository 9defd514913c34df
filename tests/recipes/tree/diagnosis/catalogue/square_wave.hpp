#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/square_wave.hpp>

namespace gyrostat::gap {

/// Starts from its defaults; the amplitude is fitted.
template <>
struct Diagnosed<effects::SquareWave> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::SquareWave::amplitude_dps};

  static std::vector<effects::SquareWave> starts(const Evidence& /*e*/) {
    return {effects::SquareWave{}};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::SquareWave& /*effect*/, const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
