#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Logarithm of the mean squared step between samples in bins of temperature, over that of all.
struct NoiseOverTemperature : Lens {
  static constexpr std::string_view title = "noise over temperature";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view coordinate = "temperature_C";
  static constexpr std::string_view unit = "ln(1)";

  NoiseOverTemperature(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    if (!seen.has_temperature()) return;
    const auto& T = seen.series().temperature_C;
    const auto edges = quantile_edges(T, spans(), 8);
    if (edges.size() < 3 || edges.back() - edges.front() < 1.0) return;
    bins_ = Bins(T, later_spans(), edges, 100);
    at = bins_.at();
  }

  void read(const Scene& scene, std::span<double> out) const {
    const auto& e = scene.rate_error_dps;
    bins_.means(
        [&](std::size_t i) {
          const double step = e[i] - e[i - 1];
          return step * step;
        },
        out);
    double mean = 0.0;
    for (std::size_t b = 0; b < at.size(); ++b) mean += out[b] / static_cast<double>(at.size());
    for (std::size_t b = 0; b < at.size(); ++b) out[b] = level(out[b]) - level(mean);
  }

 private:
  Bins bins_;
};

}  // namespace gyrostat::gap::lenses
