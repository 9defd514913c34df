#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include <gyrostat/experiments/run/trials_together.hpp>
#include <gyrostat/experiments/run/tuning.hpp>

namespace gyrostat {

/// What came out of a cell. Trials that were not run (after an interrupt) are absent.
struct CellResult {
  Calibration calibration{};
  std::vector<TunedMethod> tuned{};  ///< one a method, empty values where nothing was to be tuned
  std::vector<std::optional<Record>> trials;  ///< by trial number
  std::vector<double> nanoseconds_per_step;   ///< one a method, its metrics included

  std::size_t finished() const;
};

/// A metric of a method in every finished trial.
std::vector<double> metric_values(const CellResult& result, std::size_t method, std::size_t metric);

struct RunOptions {
  int threads = 0;                          ///< 0: as many as the machine has
  const std::atomic<bool>* stop = nullptr;  ///< once true, running trials finish and no more start
  std::uint32_t lanes = default_lanes();    ///< trials side by side; changes no byte of the result
  std::function<void(std::size_t finished)> progress{};  ///< called from any thread
};

/// A cell with its calibration, and with tuned values fixed.
struct PreparedCell {
  Cell cell;
  Calibration calibration{};
  std::vector<TunedMethod> tuned{};  ///< one a method, empty values where nothing was to be tuned
  std::optional<SharedConditions> conditions{};  ///< what its trials have in common, where they do
  std::string thrown{};  ///< by its calibration or tuning, and then the outcome of every trial
};

/// Calibrates, and tunes where methods ask for it.
PreparedCell prepare_cell(const Cell& cell, std::uint64_t seed, int threads);

/// The same; what a plug-in throws there is noted, so that it costs this cell's trials and no
/// other's. A lack of memory, InputError and Interrupted are thrown on, and all of it where the
/// cell's failure is searched for, which cannot do without the calibration.
PreparedCell prepare_or_note(const Cell& cell, std::uint64_t seed, int threads);

/// Runs those trials of the cell that are `wanted`, on oneTBB, and hands each to `take`, from any
/// thread. A trial's noise is addressed by its number, so no record depends on the number of
/// threads. Returns nanoseconds per step of each method, metrics included; NaN where nothing ran.
std::vector<double> run_trials(const PreparedCell& prepared, std::uint64_t seed,
                               const RunOptions& options,
                               const std::function<bool(std::uint32_t trial)>& wanted,
                               const std::function<void(std::uint32_t trial, Record&&)>& take);

/// Prepares a cell and runs all of its trials; each writes its own slot. Throws what a trial threw.
///
/// Example: the first cell of a study, and what its first method made of every trial.
///
///   #include <gyrostat/analysis/metric_type.hpp>
///
///   const Study study = read_study("study.json");
///   const CellResult result = run_cell(study.cells[0], study.seed, {.threads = 4});
///   const auto rmse = metric_values(result, 0, metric_named("bias_rmse", "example"));
///   std::printf("%g dps in the mean\n", summarise(rmse).mean);
///
/// Thread safety: may be called from any thread, one call at a time, since `options.threads` limits
/// oneTBB for the whole process while it runs. `options.progress` is called from many threads at
/// once. Filters and effects of the program's own are added before.
CellResult run_cell(const Cell& cell, std::uint64_t seed, const RunOptions& options);

}  // namespace gyrostat
