#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap {

/// A lens over all cluster lengths: those shorter than the conditions' cluster from single samples,
/// the others from the slow values, which have no thermal drift.
struct OctaveLens : Lens {
  static constexpr std::string_view coordinate = "tau_s";

  OctaveLens(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    for (std::size_t k = 0; k < octave_count(spans()) && (std::size_t{1} << k) < seen.cluster();
         ++k)
      add(k, seen.interval_s());
    fast_ = at.size();
    for (std::size_t k = 0; k < octave_count(slow_spans()); ++k) add(k, seen.slow_interval_s());
  }

 protected:
  template <class Value>
  void read_each(const Scene& scene, std::span<double> out, const Value& value) const {
    for (std::size_t k = 0; k < at.size(); ++k)
      out[k] = value(k < fast_ ? of(scene.octaves)[k] : of(scene.slow_octaves)[k - fast_]);
  }

 private:
  void add(std::size_t octave, double interval_s) {
    const double tau_s = interval_s * static_cast<double>(std::size_t{1} << octave);
    at.push_back({tau_s, tau_s});
  }
  std::size_t fast_ = 0;
};

}  // namespace gyrostat::gap
