#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/likelihood/marks.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/noise_averaging.hpp>

namespace gyrostat::gap {

/// Noise that is averaged once or twice, twice of the output's own samples, too, each a start of
/// its own.
template <>
struct Diagnosed<effects::NoiseAveraging> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::NoiseAveraging::length,
                                                 &effects::NoiseAveraging::after_dps};
  static constexpr std::string_view part = "output filter";
  static constexpr std::array alike = {&effects::NoiseAveraging::length};

  static std::vector<effects::NoiseAveraging> guesses(const Beside& beside) {
    const auto& c = beside.conditions;
    const double after_dps = 0.1 * noise_of_steps(c, c.series().gyro_dps);
    // What follows two averages shows where they leave nothing.
    return {{1.2, 1.0},
            {2.2, 1.0},
            {4.2, 1.0},
            {0.8, 2.0},
            {1.6, 2.0},
            {3.2, 2.0},
            {2.0, 2.0, 1.0},
            {3.0, 2.0, 1.0},
            {4.0, 2.0, 1.0},
            {1.6, 2.0, 0.0, after_dps},
            {2.0, 2.0, 1.0, after_dps},
            {3.0, 2.0, 1.0, after_dps}};
  }

  /// With white noise after it, or without.
  static std::vector<effects::NoiseAveraging> told_otherwise(const effects::NoiseAveraging& effect,
                                                             const Conditions& c) {
    auto other = effect;
    other.after_dps = effect.after_dps > 0.0 ? 0.0 : 0.3 * noise_of_steps(c, c.series().gyro_dps);
    return {other};
  }

  /// How often is; and what of two means shorter than a sample is left is a filter's as well, which
  /// need not be two that are alike.
  static std::size_t chosen_parameters(const effects::NoiseAveraging& effect) {
    return effect.stages > 1.5 && effect.length < 1.0 ? 2 : 1;
  }

  static void enter(const effects::NoiseAveraging& effect, NoiseLaw& law) {
    law.averaging = effect.autocovariance();
    law.rounding += effect.after_dps * effect.after_dps;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::NoiseAveraging& effect, const Conditions& /*c*/) {
    return effect.autocovariance().size() > 1;
  }
};

}  // namespace gyrostat::gap
