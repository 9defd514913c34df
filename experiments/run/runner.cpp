#include <gyrostat/experiments/run/runner.hpp>

#include <algorithm>
#include <new>

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/experiments/run/trials_together.hpp>

namespace gyrostat {

std::size_t CellResult::finished() const {
  return static_cast<std::size_t>(
      std::count_if(trials.begin(), trials.end(), [](const auto& t) { return t.has_value(); }));
}

std::vector<double> metric_values(const CellResult& result, std::size_t method,
                                  std::size_t metric) {
  std::vector<double> values;
  for (const auto& record : result.trials)
    if (record) values.push_back(record->of(method).metric(metric));
  return values;
}

namespace {

/// At most so many threads as long as it lives; 0: as many as the machine has.
std::optional<tbb::global_control> thread_limit(int threads) {
  std::optional<tbb::global_control> limit;
  if (threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, threads);
  return limit;
}

}  // namespace

PreparedCell prepare_cell(const Cell& cell, std::uint64_t seed, int threads) {
  const auto limit = thread_limit(threads);
  PreparedCell prepared;
  Series buffer;
  if (cell.needs_calibration()) prepared.calibration = calibrate_cell(cell, seed, 0, buffer);
  prepared.tuned = tune_methods(cell, prepared.calibration, seed);
  prepared.cell = with_tuned(cell, prepared.tuned);
  if (!cell.recording && !cell.denoise && !cell.fleet)
    prepared.conditions = shared_conditions(cell.scenario);
  return prepared;
}

PreparedCell prepare_or_note(const Cell& cell, std::uint64_t seed, int threads) {
  if (cell.failure) return prepare_cell(cell, seed, threads);
  try {
    return prepare_cell(cell, seed, threads);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& failure) {
    PreparedCell prepared{.cell = cell};
    prepared.thrown = fmt::format("calibration or tuning: {}", failure.what());
    auto& fit = prepared.calibration.random_error;
    for (const auto& field : Arima111<double>::fields())
      fit.parameters.*(field.member) = fit.standard_errors.*(field.member) = no_value;
    fit.message = prepared.thrown;
    prepared.tuned.resize(cell.methods.size());
    return prepared;
  }
}

std::vector<double> run_trials(const PreparedCell& prepared, std::uint64_t seed,
                               const RunOptions& options,
                               const std::function<bool(std::uint32_t trial)>& wanted,
                               const std::function<void(std::uint32_t trial, Record&&)>& take) {
  const auto limit = thread_limit(options.threads);
  const auto& cell = prepared.cell;
  std::vector<std::uint32_t> trials;
  for (std::uint32_t trial = 0; trial < cell.trials; ++trial)
    if (wanted(trial)) trials.push_back(trial);
  tbb::enumerable_thread_specific<std::vector<Workspace>> workspaces;
  std::atomic<std::size_t> finished{0}, next{0};
  const std::size_t packs = (trials.size() + options.lanes - 1) / options.lanes;
  tbb::parallel_for(std::size_t{0}, packs, [&](std::size_t /*turn*/) {
    // So that trials begin in order, and what is finished has few gaps.
    const std::size_t first = options.lanes * next++;
    if (options.stop && options.stop->load(std::memory_order_relaxed)) return;
    const auto pack = std::span(trials).subspan(
        first, std::min<std::size_t>(options.lanes, trials.size() - first));
    auto records =
        prepared.thrown.empty()
            ? run_trials_together(cell, prepared.calibration, seed, pack, workspaces.local(),
                                  prepared.conditions ? &*prepared.conditions : nullptr)
            : std::vector<Record>(pack.size(), thrown_record(cell, prepared.thrown));
    for (std::size_t l = 0; l < pack.size(); ++l) {
      take(pack[l], std::move(records[l]));
      const std::size_t done = ++finished;
      if (options.progress) options.progress(done);
    }
  });

  std::vector<double> nanoseconds_per_step(cell.methods.size());
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    double seconds = 0.0, steps = 0.0;
    for (const auto& lanes : workspaces) {
      if (lanes.empty()) continue;  // of trials that were never begun
      const auto& workspace = lanes.front();
      seconds += workspace.seconds[m];
      steps += workspace.steps[m];
    }
    nanoseconds_per_step[m] = steps > 0.0 ? 1e9 * seconds / steps : no_value;
  }
  return nanoseconds_per_step;
}

CellResult run_cell(const Cell& cell, std::uint64_t seed, const RunOptions& options) {
  auto prepared = prepare_cell(cell, seed, options.threads);
  CellResult result;
  result.trials.resize(cell.trials);
  const auto every = [](std::uint32_t) { return true; };
  result.nanoseconds_per_step =
      run_trials(prepared, seed, options, every, [&](std::uint32_t trial, Record&& record) {
        for (std::size_t m = 0; m < record.thrown.size(); ++m)
          if (const auto& thrown = record.thrown[m]; !thrown.empty())
            throw std::runtime_error(
                fmt::format("{}, trial {}, {}: {}", cell.name, trial, cell.methods[m].id, thrown));
        result.trials[trial] = std::move(record);
      });
  result.calibration = std::move(prepared.calibration);
  result.tuned = std::move(prepared.tuned);
  return result;
}

}  // namespace gyrostat
