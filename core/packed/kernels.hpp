#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include <gyrostat/core/step.hpp>

namespace gyrostat {

struct NormalAddress;

/// One trial in a lane: what the filter sees and where its steps go. Rate and drift are for filters
/// that need the truth, and may be null for the others.
struct Lane {
  const double* gyro_dps = nullptr;
  const double* true_rate_dps = nullptr;
  const double* true_drift_dps = nullptr;
  double* estimate_dps = nullptr;
  double* estimate_variance = nullptr;
  double* innovation_dps = nullptr;
  double* innovation_variance = nullptr;
  Status* status = nullptr;
  LearnedParameters* learned_first = nullptr;
  LearnedParameters* learned_last = nullptr;
};

/// A filter over as many trials at once as `lanes` says. Field f of the parameters of lane l is at
/// parameters[f * lanes + l].
struct PackedFilter {
  std::string_view filter;
  int lanes = 0;
  void (*run)(const double* parameters, const Lane* lanes, std::size_t samples) = nullptr;
};

/// What is compiled for one instruction set.
struct Kernels {
  std::string_view target;
  int width = 1;  ///< doubles in one of its registers
  std::span<const std::span<const PackedFilter>* const> filters;  ///< by compiled unit
  /// Normal deviates of `normal_blocks` blocks of four from block `first` on.
  void (*normals)(const NormalAddress& at, std::uint32_t first, double* out) = nullptr;
};

inline constexpr int normal_blocks = 16;

/// The instruction sets that this machine has, from the narrowest.
std::span<const Kernels* const> available_kernels();

/// The kernel of `filter` in packs of `lanes` on the widest instruction set that has one; null
/// where there is none.
const PackedFilter* packed_filter(std::string_view filter, int lanes);

}  // namespace gyrostat
