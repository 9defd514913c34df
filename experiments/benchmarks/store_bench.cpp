// Trial outcomes into the store and back: 6 methods a trial, one transaction a batch.

#include <filesystem>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <gyrostat/experiments/findings/cell_summary.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/recordings/temporary_folder.hpp>
#include <gyrostat/results/store_writer.hpp>

namespace gyrostat {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t methods = 6;

Cell six_methods(std::uint32_t trials) {
  Cell cell;
  cell.name = "bench";
  cell.trials = trials;
  for (std::size_t m = 0; m < methods; ++m)
    cell.methods.push_back({"m" + std::to_string(m), "kf", ParameterSource::truth, {}, {}});
  return cell;
}

Store store_in(const fs::path& folder, const Cell& cell) {
  Manifest manifest{
      "bench", "bench", 1, "{}", "/", outcome_columns(), {{cell.name, {}, cell.trials, 0}}};
  for (const auto& method : cell.methods) manifest.cells[0].methods.push_back(method.id);
  auto store = Store::open_or_create(folder, manifest);
  store.set_cells(manifest.cells);
  store.begin_session({"bench", {"1", "1", "1"}, "here", 1, "now", "", 0});
  return store;
}

/// As different from trial to trial as real ones.
TrialRow row_of_trial(std::uint32_t trial) {
  TrialRow row{0, trial, true, {}, {}};
  const std::size_t count = methods * outcome_columns().size();
  std::uint64_t state = trial;
  for (std::size_t i = 0; i < count; ++i) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    row.outcomes.push_back(0.02 + 1e-3 * static_cast<double>(state >> 40) / 16777216.0);
  }
  return row;
}

void fill(Store& store, std::uint32_t trials) {
  StoreWriter writer(store);
  for (std::uint32_t trial = 0; trial < trials; ++trial) writer.push(row_of_trial(trial));
  writer.finish();
}

void StoreWrite(benchmark::State& state) {
  const auto trials = static_cast<std::uint32_t>(state.range(0));
  const auto cell = six_methods(trials);
  for (auto _ : state) {
    state.PauseTiming();
    const TemporaryFolder folder;
    state.ResumeTiming();
    auto store = store_in(folder.path(), cell);
    fill(store, trials);
  }
  state.counters["outcomes/s"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * trials * methods, benchmark::Counter::kIsRate);
}
BENCHMARK(StoreWrite)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();

void StoreSummary(benchmark::State& state) {
  const auto trials = static_cast<std::uint32_t>(state.range(0));
  const auto cell = six_methods(trials);
  const TemporaryFolder folder;
  auto store = store_in(folder.path(), cell);
  fill(store, trials);
  for (auto _ : state)
    benchmark::DoNotOptimize(summarise_cell(cell, [&](const auto& visit) {
      store.for_each_trial(0, trials,
                           [&](const auto& trial) { visit(trial.calibrated, trial.outcomes); });
    }));
  state.counters["trials/s"] = benchmark::Counter(static_cast<double>(state.iterations()) * trials,
                                                  benchmark::Counter::kIsRate);
}
BENCHMARK(StoreSummary)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();

void StoreExport(benchmark::State& state) {
  const auto trials = static_cast<std::uint32_t>(state.range(0));
  const TemporaryFolder folder;
  auto store = store_in(folder.path(), six_methods(trials));
  fill(store, trials);
  for (auto _ : state) write_outcomes(folder.path() / "outcomes.csv.gz", store);
  state.counters["outcomes/s"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * trials * methods, benchmark::Counter::kIsRate);
}
BENCHMARK(StoreExport)->Arg(20000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace gyrostat
