#include <gyrostat/experiments/findings/plan.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <thread>

#include <gyrostat/experiments/findings/error_tables.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/experiments/run/stored_run.hpp>
#include <gyrostat/experiments/run/study_store.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The cell alone, with nothing tuned.
Study pilot_of(const Study& study, std::size_t index) {
  Study pilot = study;
  pilot.cells = {study.cells[index]};
  for (auto& method : pilot.cells[0].methods) method.tune.clear();
  return pilot;
}

bool is_tuned(const Cell& cell) {
  return std::any_of(cell.methods.begin(), cell.methods.end(),
                     [](const Method& method) { return !method.tune.empty(); });
}

/// Of calibration and tuning: that of a few evaluations, and more in proportion.
double preparation_seconds(const Cell& cell, std::uint64_t seed, int threads) {
  const auto with_evaluations = [&](int evaluations) {
    Cell brief = cell;
    brief.tuning.evaluations = evaluations;
    const Stopwatch watch;
    (void)prepare_cell(brief, seed, threads);
    return watch.seconds();
  };
  constexpr int few = 1, more = 5;
  const double least = with_evaluations(few);
  if (!is_tuned(cell)) return least;
  const double each = (with_evaluations(more) - least) / (more - few);
  return least + std::max(0.0, each) * (cell.tuning.evaluations - few);
}

/// What a trial takes in the store's pages of 16 KiB.
double stored_bytes(const Cell& cell) {
  constexpr double page = 16384.0, overhead = 32.0;
  const double row =
      8.0 * static_cast<double>(cell.methods.size() * outcome_columns().size()) + overhead;
  return row < page ? page / std::floor(page / row) : page * std::ceil(row / page);
}

}  // namespace

CellPlan plan_cell(const Study& study, std::size_t index, const fs::path& folder,
                   const PilotOptions& options) {
  const Cell& cell = study.cells[index];
  const int threads =
      options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency());
  const Study pilot = pilot_of(study, index);
  CellPlan plan;
  plan.steps = static_cast<double>(cell.scenario.sampling.samples()) *
               static_cast<double>(cell.methods.size()) * cell.trials;

  plan.preparation_s = preparation_seconds(cell, study.seed, options.threads);
  const auto prepared = prepare_cell(pilot.cells[0], study.seed, options.threads);

  const auto place = folder / std::to_string(index);
  fs::create_directories(place);
  Store store = open_study_store(place, pilot, Mismatch::refuse);
  CellState state(store, pilot.cells[0], 0, {});
  std::atomic<bool> stop{false};
  RunOptions run{.threads = options.threads, .stop = &stop, .progress = {}};
  const auto warm = static_cast<std::uint32_t>(std::min<std::uint64_t>(threads, cell.trials));
  run_trials(
      prepared, study.seed, run, [&](std::uint32_t trial) { return trial < warm; },
      [](std::uint32_t, Record&&) {});
  const Stopwatch trials;
  run.progress = [&](std::size_t done) {
    if (done >= warm && trials.seconds() >= options.seconds) stop = true;
  };
  run_missing(store, prepared, 0, study.seed, state, run, [](const CellProgress&) {});
  plan.trials_s = trials.seconds();

  const Stopwatch results;
  const auto summary = summarise_cell(pilot.cells[0], [&](const auto& visit) {
    store.for_each_trial(0, cell.trials, [&](const Store::TrialView& trial) {
      visit(trial.calibrated, trial.outcomes);
    });
  });
  write_outcomes(place / "outcomes.csv.gz", store);
  plan.results_s = results.seconds();

  plan.pilot_trials = static_cast<std::uint32_t>(summary.finished);
  const double share = static_cast<double>(cell.trials) / plan.pilot_trials;
  plan.trials_s *= share;
  plan.results_s *= share;
  plan.store_bytes = stored_bytes(cell) * cell.trials;
  plan.export_bytes = static_cast<double>(fs::file_size(place / "outcomes.csv.gz")) * share;
  return plan;
}

CellPlan plan_design(const Study& study, const Design& design, const fs::path& folder,
                     const PilotOptions& options) {
  const std::size_t points = design.values.size();
  std::set<std::size_t> tried = {0, points / 2, points - 1};
  PilotOptions each = options;
  each.seconds /= static_cast<double>(tried.size());
  CellPlan sum{.cells = points, .measured_cells = tried.size()};
  double steps_tried = 0.0;
  for (const auto point : tried) {
    const auto plan = plan_cell(study, design.first_cell + point, folder, each);
    steps_tried += plan.steps;
    sum.pilot_trials += plan.pilot_trials;
    for (const auto part : {&CellPlan::preparation_s, &CellPlan::trials_s, &CellPlan::results_s,
                            &CellPlan::store_bytes, &CellPlan::export_bytes})
      sum.*part += plan.*part;
  }
  for (std::size_t i = 0; i < points; ++i) {
    const auto& cell = study.cells[design.first_cell + i];
    sum.steps += static_cast<double>(cell.scenario.sampling.samples()) *
                 static_cast<double>(cell.methods.size()) * cell.trials;
  }
  const double share = static_cast<double>(points) / static_cast<double>(tried.size());
  sum.trials_s *= sum.steps / steps_tried;
  for (const auto part : {&CellPlan::preparation_s, &CellPlan::results_s, &CellPlan::store_bytes,
                          &CellPlan::export_bytes})
    sum.*part *= share;
  return sum;
}

}  // namespace gyrostat
