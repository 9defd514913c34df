#pragma once

#include <algorithm>
#include <numbers>

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

  /// The line that its frequency leaves, as wide as the frequency wanders while it is remembered.
  static void enter(const effects::WanderingLine& effect, NoiseLaw& law) {
    const double slow_hz = 2.0 * effect.wander_hz;
    const double fast_hz =
        4.0 * std::numbers::pi * effect.wander_hz * effect.wander_hz * effect.correlation_time_s;
    law.resonances.push_back({0.5 * effect.amplitude_dps * effect.amplitude_dps,
                              effect.frequency_hz, std::min(slow_hz, fast_hz)});
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  /// Neither a line that stands still nor one that is anywhere.
  static bool is_what_it_is_called(const effects::WanderingLine& effect, const Conditions& c) {
    return effect.wander_hz < 0.25 * effect.frequency_hz &&
           effect.wander_hz > spectrum_resolution_hz(c.spans(Part::train), c.rate_hz());
  }
};

}  // namespace gyrostat::gap
