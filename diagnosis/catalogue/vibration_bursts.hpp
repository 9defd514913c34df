#pragma once

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/vibration_bursts.hpp>

namespace gyrostat::gap {

/// The highest peak of the spectrum, in stretches that have it and in others.
template <>
struct Diagnosed<effects::VibrationBursts> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {
      &effects::VibrationBursts::std_dps, &effects::VibrationBursts::centre_hz,
      &effects::VibrationBursts::bandwidth_hz, &effects::VibrationBursts::mean_duration_s,
      &effects::VibrationBursts::mean_interval_s};

  static void enter(const effects::VibrationBursts& effect, NoiseLaw& law) {
    const double share = effect.mean_duration_s / (effect.mean_duration_s + effect.mean_interval_s);
    law.resonances.push_back(
        {share * effect.std_dps * effect.std_dps, effect.centre_hz, effect.bandwidth_hz});
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  /// Bursts that are longer than the vibration remembers, and that a recording has several of.
  static bool is_what_it_is_called(const effects::VibrationBursts& effect, const Conditions& c) {
    const double duration_s = c.interval_s() * static_cast<double>(c.size());
    return effect.bandwidth_hz < 0.5 * effect.centre_hz &&
           effect.mean_duration_s * effect.bandwidth_hz > 1.0 &&
           effect.mean_duration_s < effect.mean_interval_s &&
           effect.mean_duration_s + effect.mean_interval_s < 0.2 * duration_s;
  }
};

}  // namespace gyrostat::gap
