#pragma once

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/gap/spectral_bands.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/diagnosis/starts/spectral_peak.hpp>
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

  static std::vector<Start> starts(const Evidence& e) {
    const auto peak = highest_peak(e.scene.spectra[0]);
    if (peak.frequency_hz <= 0.0 || peak.power <= 0.0) return {};
    const double white = e.baseline.random_error.measurement_noise_std_dps;
    const double rest = std::max(0.1 * white * white, white * white - peak.power);
    std::vector<Start> found;
    for (const double widths : {1.0, 10.0})
      found.push_back({effects::WanderingLine{std::sqrt(2.0 * peak.power), peak.frequency_hz,
                                              0.25 * peak.width_hz, widths / peak.width_hz},
                       with_white(e, std::sqrt(rest))});
    return found;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  /// Neither a line that stands still nor one that is anywhere.
  static bool is_what_it_is_called(const effects::WanderingLine& effect, const Conditions& c) {
    return effect.wander_hz < 0.25 * effect.frequency_hz &&
           effect.wander_hz > spectrum_resolution_hz(c.spans(Part::train), c.rate_hz());
  }
};

}  // namespace gyrostat::gap
