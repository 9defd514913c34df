#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include <gyrostat/core/step.hpp>

namespace gyrostat {

struct NormalAddress;

/// What filters see of some trials in lanes: the value of lane l at sample k is at
/// [k * lanes + l]. Rate and drift are for filters that need the truth, and may be null for the
/// others.
struct PackedSamples {
  const double* gyro_dps = nullptr;
  const double* true_rate_dps = nullptr;
  const double* true_drift_dps = nullptr;
};

/// Where steps go, in lanes as the samples are.
struct PackedSteps {
  double* estimate_dps = nullptr;
  double* estimate_variance = nullptr;
  double* innovation_dps = nullptr;
  double* innovation_variance = nullptr;
  double* status = nullptr;  ///< the number of a Status
};

/// A filter over as many trials at once as `lanes` says. Its state is `bytes` long, at 64 bytes,
/// and needs no destructor. Field f of the parameters of lane l is at parameters[f * lanes + l].
struct PackedFilter {
  std::string_view filter;
  int lanes = 0;
  std::size_t bytes = 0;
  void (*start)(void* state, const double* parameters) = nullptr;
  /// The next `samples`, from where it stands.
  void (*run)(void* state, const PackedSamples& in, const PackedSteps& out,
              std::size_t samples) = nullptr;
  /// How it holds phi, delta1 and delta2 now, one a lane; null for a filter that does not.
  void (*learned)(const void* state, LearnedParameters* of_lanes) = nullptr;
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
