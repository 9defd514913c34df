#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Mean of the heading error in stretches of equal length.
struct HeadingOverTime : Lens {
  static constexpr std::string_view title = "heading error over time";
  static constexpr std::string_view channel = "heading_deg";
  static constexpr std::string_view coordinate = "time_s";
  static constexpr std::string_view unit = "deg";

  HeadingOverTime(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    const auto& t = seen.slow_time_s();
    if (!seen.has_heading() || t.size() < 128) return;
    bins_ = Bins(t, slow_spans(), even_edges(t.front(), t.back(), 48), 2);
    at = bins_.at();
  }

  void read(const Scene& scene, std::span<double> out) const {
    bins_.means([&](std::size_t i) { return scene.slow_heading_deg[i]; }, out);
  }

 private:
  Bins bins_;
};

}  // namespace gyrostat::gap::lenses
