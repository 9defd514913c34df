#pragma once

#include <cstddef>
#include <new>
#include <span>
#include <vector>

#include <gyrostat/analysis/judge/judged_steps.hpp>
#include <gyrostat/core/running_filter.hpp>
#include <gyrostat/generators/packed/signal_in_lanes.hpp>

namespace gyrostat {

/// Memory at 64 bytes, for packs and for the state of kernels. It only grows.
class PackMemory {
 public:
  void* bytes(std::size_t count);
  double* doubles(std::size_t count) { return static_cast<double*>(bytes(count * sizeof(double))); }
  /// What there is.
  void* bytes() const { return lines_.data(); }
  double* doubles() const { return static_cast<double*>(bytes()); }

 private:
  struct alignas(64) Line {
    std::byte bytes[64];
  };
  mutable std::vector<Line> lines_;
};

/// What a trial's filters see and what they are judged by.
struct TrialSignal {
  const Series* series = nullptr;
  const Series* judged = nullptr;  ///< the same, or with its rate denoised
};

/// A stretch of the signals of trials side by side, and the steps of one method over it: value of
/// lane l at sample k at [k * lanes + l]. It is small enough for the nearest cache, so that all
/// methods run over it while it is there.
class Stretch {
 public:
  /// The trials of `signals`, the last one once more in lanes that are left.
  Stretch(std::span<const TrialSignal> signals, int lanes);
  /// The same, made in lanes as it goes; loaded in order.
  Stretch(SignalInLanes& made, bool heading);

  /// Whether these signals can share their steps: as long, with the same channels.
  static bool are_alike(std::span<const TrialSignal> signals);

  std::size_t samples_of_all() const { return first_series().size(); }
  int lanes() const { return lanes_; }
  bool tells_truth() const {
    return !first_series().rate_ref_dps.empty() && !first_series().thermal_bias_dps.empty();
  }
  void load(std::size_t first);
  std::size_t first() const { return first_; }
  std::size_t samples() const { return steps_.samples; }

  const PackedSamples& seen() const { return seen_; }
  /// What trial `l` sees.
  SampleColumns seen_by(std::size_t l) const;
  const PackedSteps& made() const { return made_; }
  const JudgedSteps& judged() const { return steps_; }

 private:
  const double* interleave(double* to, const std::vector<double> Series::*channel,
                           const Series* TrialSignal::*from) const;
  explicit Stretch(int lanes);
  const Series& first_series() const {
    return made_in_lanes_ != nullptr ? made_in_lanes_->conditions() : *signals_.front().series;
  }
  void make();
  double* channel(int number) const {
    return memory_.doubles() + number * static_cast<std::size_t>(lanes_) * JudgedSteps::most;
  }

  std::span<const TrialSignal> signals_{};
  SignalInLanes* made_in_lanes_ = nullptr;
  bool heading_ = false, still_ = false;
  mutable bool heading_made_ = false;  ///< of this stretch: only epochs look at it
  int lanes_;
  std::size_t first_ = 0, filled_ = 0;
  PackMemory memory_;
  PackedSamples seen_;
  PackedSteps made_;
  JudgedSteps steps_;
};

}  // namespace gyrostat
