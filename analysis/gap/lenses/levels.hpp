#pragma once

#include "analysis/gap/octave_lens.hpp"

namespace gyrostat::gap::lenses {

/// Logarithm of the kurtosis of the means about the mean of their stretch: low where the rate
/// keeps to two levels or to a wave, ln 3 for a Gaussian wandering.
struct Levels : OctaveLens {
  static constexpr std::string_view title = "shape of the level over averaging time";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view unit = "ln(1)";

  using OctaveLens::OctaveLens;

  void read(const Scene& scene, double* out) const {
    read_each(scene, out, [](const Octave& octave) { return level(octave.level_kurtosis); });
  }
};

}  // namespace gyrostat::gap::lenses
