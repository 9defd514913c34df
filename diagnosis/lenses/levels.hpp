#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Logarithm of the kurtosis of the slow means about the mean of their stretch: low where the rate
/// keeps to two levels or to a wave, ln 3 for a Gaussian wandering.
struct Levels : Lens {
  static constexpr std::string_view title = "shape of the level over averaging time";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view coordinate = "tau_s";
  static constexpr std::string_view unit = "ln(1)";

  Levels(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    for (std::size_t k = 0; k < octave_count(slow_spans()); ++k) {
      const double tau_s = seen.slow_interval_s() * static_cast<double>(std::size_t{1} << k);
      at.push_back({tau_s, tau_s});
    }
  }

  void read(const Scene& scene, std::span<double> out) const {
    auto reading = out.begin();
    for (const auto& octave : of(scene.slow_octaves)) *reading++ = level(octave.level_kurtosis);
  }
};

}  // namespace gyrostat::gap::lenses
