#pragma once

#include <numbers>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/bias_instability.hpp>

namespace gyrostat::gap {

/// Decaying errors of all memories, alike, or of all from some time on.
template <>
struct Diagnosed<effects::BiasInstability> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::BiasInstability::coefficient_dps,
                                                 &effects::BiasInstability::shortest_s};

  static std::vector<effects::BiasInstability> guesses(const Beside& beside) {
    const double size_dps = beside.slow_std_dps();
    constexpr double samples = 16.0;
    return {
        {0.3 * size_dps}, {size_dps}, {0.3 * size_dps, samples * beside.conditions.interval_s()}};
  }

  /// Decaying errors of equal variance, their memories four times apart.
  static void enter(const effects::BiasInstability& effect, NoiseLaw& law) {
    const double variance = effect.coefficient_dps * effect.coefficient_dps * 2.0 *
                            std::numbers::ln2 / std::numbers::pi;
    for (double memory_s = std::max(law.interval_s, effect.shortest_s);
         memory_s <= 4.0 * law.duration_s; memory_s *= 4.0)
      law.decaying.push_back({variance, memory_s});
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::time(c); }

  static bool is_what_it_is_called(const effects::BiasInstability& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
