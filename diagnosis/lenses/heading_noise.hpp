#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Logarithm of the mean squared step of the heading from sample to sample, and of its kurtosis.
struct HeadingNoise : Lens {
  static constexpr std::string_view title = "heading noise from sample to sample";
  static constexpr std::string_view channel = "heading_deg";
  static constexpr std::string_view coordinate = "amplitude_dps";
  static constexpr std::string_view unit = "ln(1)";

  HeadingNoise(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    if (seen.has_heading()) at.assign(2, {0.0, 0.0});
  }

  void read(const Scene& scene, std::span<double> out) const {
    double square = 0.0, fourth = 0.0, count = 0.0;
    for (const auto& span : spans())
      for (std::size_t i = span.first + 1; i < span.last; ++i) {
        const double step = scene.heading_error_deg[i] - scene.heading_error_deg[i - 1];
        if (is_missing(step)) continue;
        square += step * step;
        fourth += step * step * step * step;
        count += 1.0;
      }
    const double mean = square / std::max(count, 1.0);
    out[0] = level(mean);
    out[1] = level(mean > 0.0 ? fourth / std::max(count, 1.0) / (mean * mean) : 3.0);
  }
};

}  // namespace gyrostat::gap::lenses
