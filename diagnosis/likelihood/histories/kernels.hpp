#pragma once

#include <cstddef>
#include <string_view>

namespace gyrostat::gap {

/// A slow law with jumps in numbers alone: of each state, the level first, what is left of it after
/// a step, the variance that drives it, and the variance that it begins with.
struct JumpLaw {
  double white, interval_s, jumps_per_s, jump_dps;
  bool is_of_two;
  int states;
  const double *decay, *drive, *first_variance;
};

/// The most states that a kernel has room for.
inline constexpr int most_states = 16;

/// Follows histories of jumps on `count` values at strictly rising points, and gives the
/// log-likelihood of all but the first. Writes into `said`, where it is not null, what histories
/// say of each value: which of two levels it is on (-1 to 1), or else the probability that the
/// level has jumped before it.
struct JumpKernel {
  double (*follow)(const JumpLaw& law, const std::size_t* points, const double* values,
                   std::size_t count, double* said) = nullptr;
};

/// That of an instruction set, as `available_kernels` names it; each gives the same bits.
const JumpKernel& jump_kernel(std::string_view target);
/// That of the widest which this machine has.
const JumpKernel& jump_kernel();

}  // namespace gyrostat::gap
