#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/gap/spectral_bands.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/diagnosis/starts/spectral_peak.hpp>
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

  static std::vector<Start> starts(const Evidence& e) {
    std::vector<Start> found;
    const auto peak = highest_peak(e.scene.spectra[0]);
    const double white = e.baseline.random_error.measurement_noise_std_dps;
    if (peak.frequency_hz <= 0.0 || peak.power <= 0.0)
      return with_noise_of(e, effects::Vibration{0.5 * white, 5.0, 1.0});
    std::vector<effects::Vibration> shapes = {resonance(e.scene.spectra[0], peak)};
    for (const double width : {0.4, 1.0})
      shapes.push_back({std::sqrt(1.3 * peak.power), peak.frequency_hz, width * peak.width_hz});
    for (const auto& shape : shapes) {
      const double rest = white * white - shape.std_dps * shape.std_dps;
      found.push_back({shape, with_white(e, std::sqrt(std::max(0.1 * white * white, rest)))});
    }
    return found;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::Vibration& effect, const Conditions& c) {
    const double line_hz =  // what its spectrum would show of a line
        3.0 * spectrum_resolution_hz(c.spans(Part::train), c.rate_hz());
    return effect.bandwidth_hz < 0.5 * effect.centre_hz &&
           effect.bandwidth_hz > std::max(0.02 * effect.centre_hz, line_hz);
  }

 private:
  /// The resonance of the same peak and power about the peak: a Lorentzian's power is pi / 2 times
  /// its height times its width.
  static effects::Vibration resonance(const Spectrum& spectrum, const SpectralPeak& peak) {
    const auto& s = spectrum.density;
    const auto low = static_cast<std::size_t>(
        std::max(1.0, (peak.frequency_hz - peak.width_hz) / spectrum.resolution_hz));
    const auto high = std::min(
        s.size() - 1,
        static_cast<std::size_t>((peak.frequency_hz + peak.width_hz) / spectrum.resolution_hz));
    std::size_t top = low;
    double height = 0.0, power = 0.0;
    for (std::size_t k = low; k < high; ++k) {
      const double around = (s[k - 1] + s[k] + s[k + 1]) / 3.0 - peak.floor;
      power += std::max(0.0, s[k] - peak.floor) * spectrum.resolution_hz;
      if (around > height) height = around, top = k;
    }
    if (height <= 0.0) return {std::sqrt(peak.power), peak.frequency_hz, peak.width_hz};
    return {std::sqrt(power), static_cast<double>(top) * spectrum.resolution_hz,
            2.0 * power / (std::numbers::pi * height)};
  }
};

}  // namespace gyrostat::gap
