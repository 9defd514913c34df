#pragma once

#include <gyrostat/diagnosis/gap/octave_lens.hpp>

namespace gyrostat::gap::lenses {

/// Logarithm of the kurtosis of the steps between neighbouring means: 0.41 fewer than ln 3 for two
/// levels, above it where changes are rare and large.
struct IncrementTails : OctaveLens {
  static constexpr std::string_view title = "tails of the increments over averaging time";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view unit = "ln(1)";

  using OctaveLens::OctaveLens;

  void read(const Scene& scene, std::span<double> out) const {
    read_each(scene, out, [](const Octave& octave) { return level(octave.kurtosis); });
  }
};

}  // namespace gyrostat::gap::lenses
