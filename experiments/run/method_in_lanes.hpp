#pragma once

#include <memory>
#include <span>
#include <vector>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/judge/kernels.hpp>
#include <gyrostat/core/held/kernels.hpp>
#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/experiments/run/stretch.hpp>
#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat {

/// The packed kernel that this method can have over such signals; null where there is none.
const PackedFilter* kernel_of(const Method& method, const Stretch& stretch);

/// A method over trials side by side, judged as it goes.
class MethodInLanes {
 public:
  /// By its kernel; `told` is by trial.
  MethodInLanes(const Method& method, const PackedFilter& kernel,
                std::span<const ParameterMap> told);
  /// Stretch by stretch, where its type can start so: side by side where it only holds its estimate
  /// between epochs, else one trial after the other.
  MethodInLanes(const Method& method, std::span<const ParameterMap> told, int lanes);
  /// By tracks that it has made already, one a trial.
  MethodInLanes(std::span<const Track* const> tracks, int lanes);

  /// Over the next stretch.
  void step(const Stretch& stretch);
  /// What each trial's steps come to, once they are all done.
  std::vector<TrackErrors> errors();

 private:
  void start_judge();
  void hold_in_lanes(const Stretch& stretch);
  void run_one_by_one(const Stretch& stretch, std::size_t first, std::size_t samples);
  void load_held(std::size_t l);
  void put_back_held(std::size_t l);
  void copy_steps(const Stretch& stretch) const;

  const PackedFilter* kernel_ = nullptr;
  const JudgeKernel* judge_;
  std::size_t trials_;
  std::vector<std::unique_ptr<RunningFilter>> running_;
  std::span<const Track* const> tracks_{};
  const HoldKernel* hold_ = nullptr;
  PackMemory filter_state_, judge_state_;  ///< where trials hold side by side, the former is theirs
  std::vector<LearnedParameters> learned_first_;
};

}  // namespace gyrostat
