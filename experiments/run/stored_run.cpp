#include <gyrostat/experiments/run/stored_run.hpp>

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/results/store_writer.hpp>

namespace gyrostat {

Json to_json(const CellProgress& p) {
  Json json = {{"cell", p.cell},
               {"finished", p.finished},
               {"trials", p.trials},
               {"failed", p.failed},
               {"trials_per_s", std::round(p.trials_per_s * 10.0) / 10.0},
               {"left_s", std::round(p.left_s)}};
  if (!p.widest.method.empty())
    json["widest"] = {{"method", p.widest.method}, {"half_width", p.widest.half_width}};
  return json;
}

std::string to_text(const CellProgress& p) {
  auto text = fmt::format("{}/{} trials, {:.0f} trials/s, {:.0f} s left", p.finished, p.trials,
                          p.trials_per_s, p.left_s);
  if (p.failed > 0) text += fmt::format(", {} failed", p.failed);
  if (!p.widest.method.empty())
    text += fmt::format(", widest ± {:.2g} ({})", p.widest.half_width, p.widest.method);
  return text;
}

CellState::CellState(const Store& store, const Cell& cell, std::uint32_t index, const Shard& shard)
    : shard_(shard), trials_(cell.trials), there_(cell.trials), watch_(cell) {
  store.for_each_trial(index, cell.trials, [&](const Store::TrialView& trial) {
    there_[trial.trial] = true;
    finished_ += shard_.owns(trial.trial);
    watch_.add(trial.outcomes);
  });
}

bool CellState::misses_below(std::uint32_t limit) const {
  for (std::uint32_t trial = 0; trial < limit; ++trial)
    if (is_missing(trial)) return true;
  return false;
}

std::vector<double> run_missing(Store& store, const PreparedCell& prepared, std::uint32_t index,
                                std::uint64_t seed, CellState& state, const RunOptions& options,
                                const std::function<void(const CellProgress&)>& watch) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  CellProgress progress{.cell = prepared.cell.name,
                        .finished = state.finished(),
                        .trials = state.trials(),
                        .failed = 0,
                        .widest = {}};
  std::uint32_t written = 0;
  StoreWriter writer(store, [&](std::span<const TrialRow> rows) {
    for (const auto& row : rows) {
      state.mark(row.trial);
      state.watch().add(row.outcomes);
      progress.failed += !row.failures.empty();
    }
    written += static_cast<std::uint32_t>(rows.size());
    progress.finished = state.finished();
    progress.trials_per_s = written / std::chrono::duration<double>(Clock::now() - start).count();
    progress.left_s = (progress.trials - progress.finished) / progress.trials_per_s;
    progress.widest = state.watch().widest();
    watch(progress);
  });
  auto nanoseconds = run_trials(
      prepared, seed, options, [&](std::uint32_t trial) { return state.is_missing(trial); },
      [&](std::uint32_t trial, Record&& record) { writer.push(row_of(index, trial, record)); });
  writer.finish();
  return nanoseconds;
}

}  // namespace gyrostat
