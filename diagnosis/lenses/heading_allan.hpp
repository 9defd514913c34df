#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Logarithm of half the mean squared step between neighbouring means of the heading error.
struct HeadingAllan : Lens {
  static constexpr std::string_view title = "Allan variance of the heading error";
  static constexpr std::string_view channel = "heading_deg";
  static constexpr std::string_view coordinate = "tau_s";
  static constexpr std::string_view unit = "ln(deg²)";

  HeadingAllan(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    if (!seen.has_heading()) return;
    for (std::size_t k = 0; k < octave_count(slow_spans()); ++k) {
      const double tau_s = seen.slow_interval_s() * static_cast<double>(std::size_t{1} << k);
      at.push_back({tau_s, tau_s});
    }
  }

  void read(const Scene& scene, std::span<double> out) const {
    auto reading = out.begin();
    for (const auto& octave : of(scene.heading_octaves))
      *reading++ = level(0.5 * octave.mean_square);
  }
};

}  // namespace gyrostat::gap::lenses
