#pragma once

#include <gyrostat/diagnosis/gap/spectral_bands.hpp>

namespace gyrostat::gap::lenses {

/// Logarithm of the mean power spectral density of the rate error in bands of a quarter octave.
struct Spectrum : Lens {
  static constexpr std::string_view title = "power spectral density over frequency";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view coordinate = "frequency_hz";
  static constexpr std::string_view unit = "ln(dps²/Hz)";

  Spectrum(const Conditions& seen, Part seen_part)
      : Lens(seen, seen_part), bands_(spectrum_size(spans()), 4.0, 1) {
    const double resolution = spectrum_resolution_hz(spans(), seen.rate_hz());
    for (const auto& bins : bands_.bins)
      at.push_back({resolution * static_cast<double>(bins.first),
                    resolution * static_cast<double>(bins.last)});
  }

  void read(const Scene& scene, std::span<double> out) const {
    auto reading = out.begin();
    const auto& density = of(scene.spectra).density;
    for (const auto& [first, last] : bands_.bins) {
      double sum = 0.0;
      for (std::size_t k = first; k < last; ++k) sum += density[k];
      *reading++ = level(sum / static_cast<double>(last - first));
    }
  }

 private:
  Bands bands_;
};

}  // namespace gyrostat::gap::lenses
