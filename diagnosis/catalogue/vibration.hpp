#pragma once

#include <cmath>
#include <numbers>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/still_line.hpp>
#include <gyrostat/generators/effects/vibration.hpp>

namespace gyrostat::gap {

/// Noise about a frequency: the highest peak of the spectrum, as wide as it is or as its
/// surroundings.
template <>
struct Diagnosed<effects::Vibration> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::Vibration::std_dps,
                                                 &effects::Vibration::centre_hz,
                                                 &effects::Vibration::bandwidth_hz};

  static std::vector<effects::Vibration> guesses(const Beside& beside) {
    std::vector<effects::Vibration> all;
    for (const auto& line : beside.lines())
      all.push_back({std::sqrt(line.variance), line.centre_hz, line.bandwidth_hz});
    return all;
  }

  static void enter(const effects::Vibration& effect, NoiseLaw& law) {
    law.resonances.push_back(
        {effect.std_dps * effect.std_dps, effect.centre_hz, effect.bandwidth_hz});
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  /// A line, and one whose top is among the frequencies that samples have; what remembers for as
  /// long as the recording stands still.
  static bool is_what_it_is_called(const effects::Vibration& effect, const Conditions& c) {
    return effect.bandwidth_hz < 0.5 * effect.centre_hz && effect.centre_hz <= 0.5 * c.rate_hz() &&
           1.0 < std::numbers::pi * effect.bandwidth_hz * longest_memory_of_a_line_s(c);
  }
};

}  // namespace gyrostat::gap
