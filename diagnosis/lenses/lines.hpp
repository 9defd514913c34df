#pragma once

#include <gyrostat/diagnosis/gap/spectral_bands.hpp>

namespace gyrostat::gap::lenses {

/// Logarithm of the highest bin of a band over its mean: a line stands out, narrow-band noise less.
/// Slow bands are those of the cluster means.
struct Lines : Lens {
  static constexpr std::string_view title = "spectral lines over frequency";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view coordinate = "frequency_hz";
  static constexpr std::string_view unit = "ln(1)";

  Lines(const Conditions& seen, Part seen_part)
      : Lens(seen, seen_part),
        slow_(spectrum_size(slow_spans()), 1.0, 8),
        fast_(spectrum_size(spans()), 2.0, 12) {
    add(slow_, spectrum_resolution_hz(slow_spans(), 1.0 / seen.slow_interval_s()));
    add(fast_, spectrum_resolution_hz(spans(), seen.rate_hz()));
  }

  void read(const Scene& scene, std::span<double> out) const {
    const auto slow = slow_.bins.size();
    peaks(slow_, of(scene.slow_spectra).density, out.first(slow));
    peaks(fast_, of(scene.spectra).density, out.subspan(slow));
  }

 private:
  void add(const Bands& bands, double resolution_hz) {
    for (const auto& bins : bands.bins)
      at.push_back({resolution_hz * static_cast<double>(bins.first),
                    resolution_hz * static_cast<double>(bins.last)});
  }
  static void peaks(const Bands& bands, const std::vector<double>& density, std::span<double> out) {
    auto reading = out.begin();
    for (const auto& [first, last] : bands.bins) {
      double sum = 0.0, highest = 0.0;
      for (std::size_t k = first; k < last; ++k) {
        sum += density[k];
        highest = std::max(highest, density[k]);
      }
      *reading++ = level(highest * static_cast<double>(last - first) / std::max(sum, 1e-300));
    }
  }
  Bands slow_, fast_;
};

}  // namespace gyrostat::gap::lenses
