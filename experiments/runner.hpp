#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "experiments/trial_pack.hpp"
#include "experiments/tuning.hpp"

namespace gyrostat {

/// What came out of a cell. Trials that were not run (after an interrupt) are absent.
struct CellResult {
  Calibration calibration;
  std::vector<TunedMethod> tuned;  ///< one a method, empty values where nothing was to be tuned
  std::vector<std::optional<Record>> trials;  ///< by trial number
  std::vector<double> nanoseconds_per_step;   ///< one a method, its metrics included

  std::size_t finished() const;
};

/// A metric of a method in every finished trial.
std::vector<double> metric_values(const CellResult& result, std::size_t method, std::size_t metric);

struct RunOptions {
  int threads = 0;                           ///< 0: as many as the machine has
  const std::atomic<bool>* stop = nullptr;   ///< once true, running trials finish and no more start
  std::uint32_t lanes = default_lanes;       ///< trials side by side; changes no byte of the result
  std::function<void(std::size_t finished)> progress;  ///< called from any thread
};

/// Calibrates, tunes where methods ask for it, and runs the trials of a cell on oneTBB. Each trial writes its own slot and its noise is addressed by
/// its number, so the result does not depend on the number of threads.
CellResult run_cell(const Cell& cell, std::uint64_t seed, const RunOptions& options);

}  // namespace gyrostat
