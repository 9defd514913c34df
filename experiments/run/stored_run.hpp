#pragma once

#include <chrono>
#include <functional>
#include <vector>

#include <gyrostat/experiments/run/interval_watch.hpp>
#include <gyrostat/experiments/run/runner.hpp>
#include <gyrostat/experiments/run/shard.hpp>
#include <gyrostat/results/store.hpp>

namespace gyrostat {

/// How far a cell is, for those who watch.
struct CellProgress {
  std::string cell;
  std::uint32_t finished = 0;  ///< of `trials`, earlier sessions included
  std::uint32_t trials = 0;    ///< that this shard owns
  std::uint32_t failed = 0;    ///< trials in quarantine; `run_missing` counts those it puts there
  double trials_per_s = 0.0;   ///< of this session
  double left_s = 0.0;
  IntervalWatch::Widest widest;
};

/// As one JSON object, for the log and for `status`.
Json to_json(const CellProgress& progress);
/// As one line: "ramp: 10/40 trials, 3 trials/s, 10 s left, 1 failed, widest ± 0.01 (kf)".
std::string to_text(const CellProgress& progress);

/// What a store holds of a cell's trials, and what it lacks.
class CellState {
 public:
  CellState(const Store& store, const Cell& cell, std::uint32_t index, const Shard& shard);

  bool is_missing(std::uint32_t trial) const { return shard_.owns(trial) && !there_[trial]; }
  std::uint32_t missing() const { return shard_.share_of(trials_) - finished_; }
  bool misses_below(std::uint32_t limit) const;
  std::uint32_t finished() const { return finished_; }  ///< of those that the shard owns
  std::uint32_t trials() const { return shard_.share_of(trials_); }
  void mark(std::uint32_t trial) { there_[trial] = true, ++finished_; }
  IntervalWatch& watch() { return watch_; }

 private:
  Shard shard_;
  std::uint32_t trials_, finished_ = 0;
  std::vector<bool> there_;  ///< one bit a trial
  IntervalWatch watch_;
};

/// Runs what is missing of a cell, of the first `prepared.cell.trials`, and puts it into the store,
/// failures included. `watch` hears of every batch once it is in the store, from the writing
/// thread; trials that it counts can no more be lost. Returns nanoseconds per step, one a method.
std::vector<double> run_missing(Store& store, const PreparedCell& prepared, std::uint32_t index,
                                std::uint64_t seed, CellState& state, const RunOptions& options,
                                const std::function<void(const CellProgress&)>& watch);

}  // namespace gyrostat
