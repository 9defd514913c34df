#include <gyrostat/experiments/findings/run_tables.hpp>

#include <fmt/format.h>

#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/findings/error_tables.hpp>
#include <gyrostat/experiments/findings/failure_sensitivity.hpp>
#include <gyrostat/experiments/findings/failures.hpp>
#include <gyrostat/experiments/findings/ranking.hpp>
#include <gyrostat/experiments/findings/ranking_words.hpp>
#include <gyrostat/experiments/findings/sensitivity.hpp>
#include <gyrostat/experiments/findings/sensitivity_words.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/results/render/render.hpp>

namespace gyrostat {
namespace {

void add_cell(const Cell& cell, const Store& store, const RanCell& ran, RunTables& all,
              std::vector<CellRanking>& rankings) {
  const TrialSource trials = [&](const auto& visit) {
    store.for_each_trial(ran.index, cell.trials, [&](const Store::TrialView& trial) {
      visit(trial.calibrated, trial.outcomes);
    });
  };
  const auto summary = summarise_cell(cell, trials);
  if (cell.needs_calibration())
    all.tables.push_back(calibration_table(cell, ran.prepared.calibration, summary));
  if (auto tuning = tuning_table(cell, ran.prepared.tuned); !tuning.rows.empty())
    all.tables.push_back(std::move(tuning));
  auto errors = error_tables(cell, summary);
  if (ran.stopped_by)
    errors.front().notes.push_back(fmt::format("stopped by its rule after {}: {}",
                                               counted(cell.trials, "trial"), *ran.stopped_by));
  for (auto& table : errors) all.tables.push_back(std::move(table));
  if (cell.methods.size() > 1) {
    rankings.push_back(rank_cell(cell, trials));
    all.tables.push_back(ranking_table(rankings.back()));
  }
  if (!ran.nanoseconds_per_step.empty())
    all.timings.push_back(timing_table(cell, ran.nanoseconds_per_step));
}

void add_designs(Study study, const Store& store, const std::filesystem::path& folder,
                 RunTables& all) {
  std::erase_if(study.designs, [](const Design& design) { return !design.is_sampled(); });
  if (study.designs.empty()) return;
  for (const auto& found :
       {sensitivities(study, store), failure_sensitivities(study, store, folder)}) {
    for (const auto& sensitivity : found)
      if (const auto sentence = sensitivity_sentence(sensitivity); !sentence.empty())
        all.answer += (all.answer.empty() ? "" : " ") + sentence + ".";
    for (auto& table : sensitivity_tables(found, study)) all.tables.push_back(std::move(table));
    for (auto& table : point_tables(found, study)) all.points.push_back(std::move(table));
  }
}

}  // namespace

std::vector<Table> RunTables::with_points(std::size_t most) const {
  auto all = tables;
  for (const auto& table : points)
    if (table.rows.size() <= most) all.push_back(table);
  return all;
}

RunTables run_tables(const Study& study, const Store& store, const std::vector<RanCell>& ran,
                     const std::filesystem::path& folder) {
  RunTables all;
  std::vector<CellRanking> rankings;
  for (const auto& r : ran) {
    const auto& cell = study.cells[r.index];
    add_cell(cell, store, r, all, rankings);
    if (cell.failure)
      all.tables.push_back(failure_table(cell, failure_findings(study, store, r.index, folder)));
  }
  all.answer = answer_in_words(rankings);
  add_designs(study, store, folder, all);
  return all;
}

void write_results(const std::filesystem::path& folder, const Store& store,
                   const RunTables& tables) {
  constexpr std::size_t most_rows = 1000000;
  const auto all = tables.with_points(most_rows);
  write_outcomes(folder / "outcomes.csv.gz", store);
  write_atomically(folder / "tables.json", render(all, Format::json));
  write_atomically(folder / "tables.md", render(all, Format::markdown));
}

}  // namespace gyrostat
