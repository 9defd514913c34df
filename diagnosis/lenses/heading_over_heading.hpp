#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Mean of the heading error in bins of the true heading: iron turns with the vehicle.
struct HeadingOverHeading : Lens {
  static constexpr std::string_view title = "heading error over heading";
  static constexpr std::string_view channel = "heading_deg";
  static constexpr std::string_view coordinate = "heading_deg";
  static constexpr std::string_view unit = "deg";

  HeadingOverHeading(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    if (!seen.has_heading() || !seen.has_motion()) return;
    std::vector<double> heading(seen.turned_deg());
    for (auto& angle : heading) angle = wrap_degrees(angle);
    bins_ = Bins(heading, spans(), even_edges(-180.0, 180.0, 16), 20);
    at = bins_.at();
    if (at.size() < 3) at.clear();
  }

  void read(const Scene& scene, std::span<double> out) const {
    bins_.means([&](std::size_t i) { return scene.heading_error_deg[i]; }, out);
  }

 private:
  Bins bins_;
};

}  // namespace gyrostat::gap::lenses
