#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Mean square of the slow rate error in stretches of equal length.
struct WanderOverTime : Lens {
  static constexpr std::string_view title = "wandering over time";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view coordinate = "time_s";
  static constexpr std::string_view unit = "dps²";

  WanderOverTime(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    const auto& t = seen.slow_time_s();
    if (t.size() < 128) return;
    bins_ = Bins(t, slow_spans(), even_edges(t.front(), t.back(), 8), 2);
    at = bins_.at();
  }

  void read(const Scene& scene, auto out) const {
    bins_.means([&](std::size_t i) { return scene.slow_dps[i] * scene.slow_dps[i]; }, out);
  }

 private:
  Bins bins_;
};

}  // namespace gyrostat::gap::lenses
