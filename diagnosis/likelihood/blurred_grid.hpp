#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {

/// A grid that values lie about: noise came after they were rounded to it.
struct BlurredGrid {
  double lsb_dps, offset_dps, noise_dps;

  double nearest_dps(double value_dps) const;
};

/// The grid of the train part, where noise of up to a sixth of its step has not hidden it: noise
/// before it leaves nothing of the values' characteristic function from about the inverse of its
/// deviation on, and the grid its harmonics (Widrow and Kollar, Quantization Noise, 2008, ch. 4).
/// None where the values are not about one, or all on it.
std::optional<BlurredGrid> blurred_grid(const Simulator& simulator,
                                        const std::vector<double>& gyro_dps);

}  // namespace gyrostat::gap
