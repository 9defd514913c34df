#pragma once

#include <cstddef>

#include <gyrostat/core/packed/kernels.hpp>

namespace gyrostat {

/// The numbers of a HeldInterval, of as many trials as there are lanes each: number i of lane l at
/// [i * lanes + l], in the order of its members.
inline constexpr std::size_t held_numbers = 7;

/// Takes samples of trials side by side whose filters only hold: steps without a measurement.
struct HoldKernel {
  int lanes = 0;
  /// Ends before the first sample at which an epoch is due in some lane, and says how many samples
  /// it took. Values of lane l at sample k are at [k * lanes + l].
  std::size_t (*run)(double* held, const double* t_s, const double* gyro_dps,
                     const PackedSteps& out, std::size_t samples) = nullptr;
};

/// That of the widest instruction set that has one for so many lanes; null where there is none.
const HoldKernel* hold_kernel(int lanes);

}  // namespace gyrostat
