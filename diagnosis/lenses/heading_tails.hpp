#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Logarithms of the kurtosis of the steps, and of the level, of the heading error: disturbances
/// come and go.
struct HeadingTails : Lens {
  static constexpr std::string_view title = "tails of the heading error";
  static constexpr std::string_view channel = "heading_deg";
  static constexpr std::string_view coordinate = "tau_s";
  static constexpr std::string_view unit = "ln(1)";

  HeadingTails(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    if (!seen.has_heading()) return;
    for (int kind = 0; kind < 2; ++kind)
      for (std::size_t k = 0; k < octave_count(slow_spans()); ++k) {
        const double tau_s = seen.slow_interval_s() * static_cast<double>(std::size_t{1} << k);
        at.push_back({tau_s, tau_s});
      }
  }

  void read(const Scene& scene, std::span<double> out) const {
    auto reading = out.begin();
    for (const auto& octave : of(scene.heading_octaves)) *reading++ = level(octave.kurtosis);
    for (const auto& octave : of(scene.heading_octaves)) *reading++ = level(octave.level_kurtosis);
  }
};

}  // namespace gyrostat::gap::lenses
