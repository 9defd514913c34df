#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Mean of the rate error, without its thermal drift, over temperature: first the rising branch,
/// then the falling one.
struct BiasOverTemperature : Lens {
  static constexpr std::string_view title = "bias over temperature, rising and falling";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view coordinate = "temperature_C";
  static constexpr std::string_view unit = "dps";

  BiasOverTemperature(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    if (!seen.has_temperature()) return;
    const auto& T = seen.slow_temperature_C();
    const auto edges = quantile_edges(T, slow_spans(), 8);
    if (edges.size() < 3 || edges.back() - edges.front() < 2.0) return;
    const auto& warming = seen.slow_warming_C_per_s();
    std::vector<double> branch(T.size());
    for (const bool rising : {true, false}) {
      for (std::size_t i = 0; i < T.size(); ++i)
        branch[i] = (warming[i] > 0.0) == rising ? T[i] : no_value;
      auto& bins = rising ? rising_ : falling_;
      bins = Bins(branch, slow_spans(), edges, 3);
      at.insert(at.end(), bins.at().begin(), bins.at().end());
    }
  }

  void read(const Scene& scene, std::span<double> out) const {
    const auto value = [&](std::size_t i) { return scene.slow_dps[i]; };
    rising_.means(value, out);
    falling_.means(value, out.subspan(rising_.at().size()));
  }

 private:
  Bins rising_, falling_;
};

}  // namespace gyrostat::gap::lenses
