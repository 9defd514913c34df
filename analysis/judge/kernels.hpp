#pragma once

#include <cstddef>

#include <gyrostat/analysis/judge/judged_steps.hpp>

namespace gyrostat {

struct TrackErrors;

/// Judges as many trials at once as `lanes` says. Its state is `bytes` long, at 64 bytes, and needs
/// no destructor.
struct JudgeKernel {
  int lanes = 1;
  std::size_t bytes = 0;
  void (*start)(void* state) = nullptr;
  void (*add)(void* state, const JudgedSteps& steps) = nullptr;
  /// Into one TrackErrors a lane; what filters learnt is left as it is.
  void (*finish)(const void* state, TrackErrors* errors) = nullptr;
  /// What there is to compensate, drift and random error: adds the number of samples that have it
  /// to the first half of `sums`, which are two a lane, and its squares to the second.
  void (*uncompensated)(const JudgedSteps& steps, double* sums) = nullptr;
};

/// That of the widest instruction set that has one for so many lanes; null where there is none. One
/// lane is always there.
const JudgeKernel* judge_kernel(int lanes);

}  // namespace gyrostat
