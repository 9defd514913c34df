#pragma once

#include <gyrostat/diagnosis/gap/octave_lens.hpp>

namespace gyrostat::gap::lenses {

/// Logarithm of the Allan variance: how much the rate wanders at each averaging time.
struct Allan : OctaveLens {
  static constexpr std::string_view title = "Allan variance over averaging time";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view unit = "ln(dps²)";

  using OctaveLens::OctaveLens;

  void read(const Scene& scene, std::span<double> out) const {
    read_each(scene, out, [](const Octave& octave) { return level(0.5 * octave.mean_square); });
  }
};

}  // namespace gyrostat::gap::lenses
