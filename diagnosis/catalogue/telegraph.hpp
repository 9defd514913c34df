#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/slow_noise.hpp>
#include <gyrostat/generators/effects/telegraph.hpp>

namespace gyrostat::gap {

/// The Allan variance is that of a Gauss-Markov process; the two levels are seen by their
/// shape.
template <>
struct Diagnosed<effects::Telegraph> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::Telegraph::amplitude_dps,
                                                 &effects::Telegraph::mean_dwell_s};

  static std::vector<effects::Telegraph> guesses(const Beside& beside) {
    std::vector<effects::Telegraph> all;
    for (const double memory_s : beside.memories_s())
      all.push_back({0.7 * beside.slow_std_dps(), 2.0 * memory_s});
    return all;
  }

  static void enter(const effects::Telegraph& effect, NoiseLaw& law) {
    law.jumps = {Jumps::To::the_other_level, effect.amplitude_dps, 1.0 / effect.mean_dwell_s};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::Telegraph& effect, const Conditions& c) {
    const double duration_s = c.interval_s() * static_cast<double>(c.size());
    return is_slow(effect.mean_dwell_s, c) && effect.mean_dwell_s < duration_s / 10.0;
  }
};

}  // namespace gyrostat::gap
