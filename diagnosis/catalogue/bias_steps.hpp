#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/bias_steps.hpp>

namespace gyrostat::gap {

/// Jumps of the slow rate, and nothing between them.
template <>
struct Diagnosed<effects::BiasSteps> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::BiasSteps::steps_per_hour,
                                                 &effects::BiasSteps::std_dps};

  static std::vector<effects::BiasSteps> guesses(const Beside& beside) {
    std::vector<effects::BiasSteps> all;
    const double hours = beside.fit.scenario.sampling.duration_s / 3600.0;
    for (const double steps : {2.0, 6.0, 20.0})
      for (const double size : {1.0, 3.0})
        all.push_back({steps / hours, size * beside.slow_std_dps()});
    return all;
  }

  static void enter(const effects::BiasSteps& effect, NoiseLaw& law) {
    law.jumps = {Jumps::To::another_level, effect.std_dps, effect.steps_per_hour / 3600.0};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  /// What jumps every second or two, or by degrees, is the sensor in motion, and what does so every
  /// few seconds beside one is left of that; what would not have jumped once has not.
  static bool is_what_it_is_called(const effects::BiasSteps& effect, const Conditions& c) {
    constexpr double largest_dps = 5.0, fewest_steps = 0.2;
    const double least_wait_s = c.has_motion() ? 5.0 : 2.5;
    const double hours = c.interval_s() * static_cast<double>(c.size()) / 3600.0;
    return effect.steps_per_hour * hours >= fewest_steps &&
           effect.steps_per_hour * least_wait_s <= 3600.0 && effect.std_dps <= largest_dps;
  }
};

}  // namespace gyrostat::gap
