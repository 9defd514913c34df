#pragma once

#include <gyrostat/diagnosis/gap/distinct_values.hpp>
#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Logarithms of: the share of distinct values among neighbours in size, samples that repeat the
/// one before, and samples that repeat the two before. Values on a grid, and stale ones.
struct Lattice : Lens {
  static constexpr std::string_view title = "repeated and distinct values";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view coordinate = "amplitude_dps";
  static constexpr std::string_view unit = "ln(1)";
  /// Of the logarithm of a count of one or two, which a few repeats in a long recording make.
  static constexpr double least_spread = 0.35;

  static constexpr std::size_t inspected = 20000;

  Lattice(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    if (octave_count(spans()) > 0) at.assign(3, {0.0, 0.0});
  }

  void read(const Scene& scene, std::span<double> out) const {
    std::vector<double> values;
    double pairs = 0.0, triples = 0.0, count = 0.0;
    for (const auto& span : spans())
      for (std::size_t i = span.first + 2; i < span.last; ++i) {
        const auto& z = scene.recorded_dps;
        const bool pair = z[i] == z[i - 1];
        pairs += pair ? 1.0 : 0.0;
        triples += pair && z[i] == z[i - 2] ? 1.0 : 0.0;
        count += 1.0;
        if (values.size() < inspected && !is_missing(z[i])) values.push_back(z[i]);
      }
    const auto share_of = [](std::size_t some, std::size_t all) {
      return static_cast<double>(std::max<std::size_t>(1, some)) /
             static_cast<double>(std::max<std::size_t>(1, all));
    };
    out[0] = std::log(share_of(distinct_values(values), values.size()));
    out[1] = std::log((pairs + 2.0) / count);
    out[2] = std::log((triples + 2.0) / count);
  }
};

}  // namespace gyrostat::gap::lenses
