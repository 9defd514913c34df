#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Mean of the rate error in bins of the reference rate.
struct ErrorOverRate : Lens {
  static constexpr std::string_view title = "rate error over rate";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view coordinate = "rate_dps";
  static constexpr std::string_view unit = "dps";

  ErrorOverRate(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    if (!seen.has_motion()) return;
    bins_ = Bins(seen.series().rate_ref_dps, spans(), rate_edges(seen.series().rate_ref_dps), 50);
    at = bins_.at();
    if (at.size() < 3) at.clear();
  }

  void read(const Scene& scene, std::span<double> out) const {
    bins_.means([&](std::size_t i) { return scene.rate_error_dps[i]; }, out);
    double mean = 0.0;  // the bias over time is another lens's
    for (std::size_t b = 0; b < at.size(); ++b) mean += out[b] / static_cast<double>(at.size());
    for (std::size_t b = 0; b < at.size(); ++b) out[b] -= mean;
  }

 private:
  Bins bins_;
};

}  // namespace gyrostat::gap::lenses
