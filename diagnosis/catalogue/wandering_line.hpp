#pragma once

#include <cmath>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/gap/spectral_bands.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/wandering_line.hpp>

namespace gyrostat::gap {

/// A peak of the spectrum that is wider than a line's, of a sine that wanders through its width, at
/// once or over many periods.
template <>
struct Diagnosed<effects::WanderingLine> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {
      &effects::WanderingLine::amplitude_dps, &effects::WanderingLine::frequency_hz,
      &effects::WanderingLine::wander_hz, &effects::WanderingLine::correlation_time_s};

  static void enter(const effects::WanderingLine& effect, NoiseLaw& law) {
    law.wandering.push_back(effect);
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  /// Neither a line that stands still nor one that is anywhere.
  static bool is_what_it_is_called(const effects::WanderingLine& effect, const Conditions& c) {
    return effect.wander_hz < 0.25 * effect.frequency_hz &&
           effect.wander_hz > spectrum_resolution_hz(c.spans(Part::train), c.rate_hz());
  }
};

}  // namespace gyrostat::gap
