#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/gap/spectral_bands.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/still_line.hpp>
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

  /// Bands wider than a line that stands still, each filled by one that wanders slowly through it.
  static std::vector<effects::WanderingLine> guesses(const Beside& beside) {
    const double resolution_hz = beside.fitter.reduced().grid().resolution_hz();
    std::vector<effects::WanderingLine> all;
    for (const auto& line : beside.lines()) {
      const double wander_hz = 0.5 * line.bandwidth_hz;
      constexpr double radians = 3.0;  // of its phase, within a correlation time
      if (wander_hz > 0.5 * resolution_hz)
        all.push_back({std::sqrt(2.0 * line.variance), line.centre_hz, wander_hz,
                       radians / (2.0 * std::numbers::pi * wander_hz)});
    }
    return all;
  }

  static void enter(const effects::WanderingLine& effect, NoiseLaw& law) {
    law.wandering.push_back(effect);
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  /// Neither a line that stands still, its phase the same for as long as the recording, nor one
  /// that is anywhere, and one that samples have.
  static bool is_what_it_is_called(const effects::WanderingLine& effect, const Conditions& c) {
    return effect.coherence(longest_memory_of_a_line_s(c)) < std::exp(-1.0) &&
           effect.wander_hz < 0.25 * effect.frequency_hz &&
           effect.frequency_hz <= 0.5 * c.rate_hz() &&
           effect.wander_hz > spectrum_resolution_hz(c.spans(Part::train), c.rate_hz());
  }
};

}  // namespace gyrostat::gap
