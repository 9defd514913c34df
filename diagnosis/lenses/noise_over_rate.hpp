#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Logarithm of the mean squared step of the rate error in bins of the reference rate: clipped
/// samples and dead zones have none.
struct NoiseOverRate : Lens {
  static constexpr std::string_view title = "noise over rate";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view coordinate = "rate_dps";
  static constexpr std::string_view unit = "ln(dps²)";

  NoiseOverRate(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    if (!seen.has_motion()) return;
    bins_ =
        Bins(seen.series().rate_ref_dps, later_spans(), rate_edges(seen.series().rate_ref_dps), 50);
    at = bins_.at();
    if (at.size() < 3) at.clear();
  }

  void read(const Scene& scene, std::span<double> out) const {
    const auto& e = scene.rate_error_dps;
    bins_.means(
        [&](std::size_t i) {
          const double step = e[i] - e[i - 1];
          return step * step;
        },
        out);
    for (std::size_t b = 0; b < at.size(); ++b) out[b] = level(out[b]);
  }

 private:
  Bins bins_;
};

}  // namespace gyrostat::gap::lenses
