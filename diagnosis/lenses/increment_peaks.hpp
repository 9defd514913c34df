#pragma once

#include <gyrostat/diagnosis/gap/octave_lens.hpp>

namespace gyrostat::gap::lenses {

/// Logarithm of the largest squared step over the mean one.
struct IncrementPeaks : OctaveLens {
  static constexpr std::string_view title = "largest increment over averaging time";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view unit = "ln(1)";

  using OctaveLens::OctaveLens;

  void read(const Scene& scene, std::span<double> out) const {
    read_each(scene, out, [](const Octave& octave) { return level(octave.peak); });
  }
};

}  // namespace gyrostat::gap::lenses
