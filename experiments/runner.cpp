#include "experiments/runner.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace gyrostat {

std::size_t CellResult::finished() const {
  return static_cast<std::size_t>(
      std::count_if(trials.begin(), trials.end(), [](const auto& t) { return t.has_value(); }));
}

std::vector<double> metric_values(const CellResult& result, std::size_t method,
                                  std::size_t metric) {
  std::vector<double> values;
  for (const auto& record : result.trials)
    if (record) values.push_back(record->outcomes[method].metrics[metric]);
  return values;
}

CellResult run_cell(const Cell& cell, std::uint64_t seed, const RunOptions& options) {
  std::optional<tbb::global_control> limit;
  if (options.threads > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism, options.threads);

  CellResult result;
  result.trials.resize(cell.trials);
  Series buffer;
  if (cell.needs_calibration()) result.calibration = calibrate_cell(cell, seed, 0, buffer);
  result.tuned = tune_methods(cell, result.calibration, seed);
  const Cell fixed = with_tuned(cell, result.tuned);

  tbb::enumerable_thread_specific<std::vector<Workspace>> workspaces;
  std::atomic<std::size_t> finished{0};
  const std::uint32_t packs = (cell.trials + options.lanes - 1) / options.lanes;
  tbb::parallel_for(std::uint32_t{0}, packs, [&](std::uint32_t pack) {
    if (options.stop && options.stop->load(std::memory_order_relaxed)) return;
    std::vector<std::uint32_t> trials;
    for (auto trial = pack * options.lanes;
         trial < cell.trials && trials.size() < options.lanes; ++trial)
      trials.push_back(trial);
    auto records = run_trial_pack(fixed, result.calibration, seed, trials, workspaces.local());
    for (std::size_t l = 0; l < trials.size(); ++l) {
      result.trials[trials[l]] = std::move(records[l]);
      const std::size_t done = ++finished;
      if (options.progress) options.progress(done);
    }
  });

  result.nanoseconds_per_step.resize(cell.methods.size());
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    double seconds = 0.0, steps = 0.0;
    for (const auto& lanes : workspaces) {
      const auto& workspace = lanes.front();
      seconds += workspace.seconds[m];
      steps += workspace.steps[m];
    }
    result.nanoseconds_per_step[m] = steps > 0.0 ? 1e9 * seconds / steps : no_value;
  }
  return result;
}

}  // namespace gyrostat
