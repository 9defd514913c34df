#include <gyrostat/experiments/run/failure_run.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/experiments/run/trials_together.hpp>
#include <gyrostat/experiments/study/digest.hpp>
#include <gyrostat/results/store_writer.hpp>

namespace gyrostat {
namespace {

SubsetPlan plan_of(const FailureRule& rule) {
  return {.threshold = rule.worst_allowed(), .samples = rule.samples, .most_levels = rule.levels};
}

/// All of a rule that decides which trials a search asks for.
std::string text_of(const FailureRule& rule, const Cell& cell) {
  auto text = fmt::format("{} {} {} {:.17g} {} {} {}", cell.name, rule.metric, rule.above,
                          rule.threshold, rule.runs, rule.samples, rule.levels);
  for (const auto m : rule.methods) text += " " + cell.methods[m].id;
  return text;
}

/// The badness of every trial of a search that a store has, by number.
std::vector<double> stored_badness(const FailureRule& rule, const Store& store, std::uint32_t cell,
                                   std::uint32_t numbers) {
  std::vector<double> badness(numbers, no_value);
  store.for_each_trial(cell, numbers, [&](const Store::TrialView& trial) {
    badness[trial.trial] = rule.badness(Outcome(trial.outcomes).metric(rule.metric));
  });
  return badness;
}

/// Runs those of the moves whose badness is not known yet, and fills it in; whether all are known.
class MovesTogether {
 public:
  MovesTogether(const PreparedCell& prepared, const FailureRule& rule, std::uint64_t seed,
                const StudyRunOptions& options, const std::atomic<bool>& stop)
      : prepared_(prepared), rule_(rule), seed_(seed), options_(options), stop_(stop) {}

  bool run(const FailureSearch& search, const std::vector<SubsetMove>& moves,
           std::vector<double>& badness,
           const std::function<void(std::uint32_t, const Record&)>& take) {
    std::vector<SubsetMove> missing;
    for (const auto& move : moves)
      if (std::isnan(badness[move.trial])) missing.push_back(move);
    const std::size_t packs = (missing.size() + options_.lanes - 1) / options_.lanes;
    tbb::parallel_for(std::size_t{0}, packs, [&](std::size_t pack) {
      if (stop_.load(std::memory_order_relaxed)) return;
      const std::size_t first = pack * options_.lanes;
      const auto some = std::span(missing).subspan(
          first, std::min<std::size_t>(options_.lanes, missing.size() - first));
      std::vector<std::vector<NoiseShare>> shares;
      std::vector<Noise> noises;
      for (const auto& move : some) shares.push_back(search.run_of(move.trial).shares(move));
      for (std::size_t i = 0; i < some.size(); ++i)
        noises.push_back({seed_, some[i].trial, shares[i]});
      const auto records =
          run_trials_together(prepared_.cell, prepared_.calibration, noises, workspaces_.local());
      for (std::size_t i = 0; i < some.size(); ++i) {
        badness[some[i].trial] = rule_.badness(records[i].of(0).metric(rule_.metric));
        take(some[i].trial, records[i]);
      }
    });
    return std::none_of(missing.begin(), missing.end(),
                        [&](const SubsetMove& move) { return std::isnan(badness[move.trial]); });
  }

 private:
  const PreparedCell& prepared_;
  const FailureRule& rule_;
  std::uint64_t seed_;
  const StudyRunOptions& options_;
  const std::atomic<bool>& stop_;
  tbb::enumerable_thread_specific<std::vector<Workspace>> workspaces_;
};

/// What was looked for under another rule is of no use to this one, whose trials have the same
/// numbers and other deviates.
Store open_failure_store(const std::filesystem::path& folder, const Study& failures,
                         Mismatch mismatch, const RunWatcher& watcher) {
  std::filesystem::create_directories(folder);
  if (mismatch != Mismatch::set_aside && std::filesystem::exists(folder / Store::file_name) &&
      Store::open(folder).manifest().digest != failures.digest) {
    const auto aside = Store::set_aside(folder);
    if (watcher.say && aside)
      watcher.say("what counts as a failure has changed: the search before is kept as " +
                  aside->string());
  }
  return open_study_store(folder, failures, mismatch);
}

/// Looks for the failure of one method until it is found or `stop` says so.
void search_failure(Store& store, std::uint32_t index, const PreparedCell& prepared,
                    const FailureRule& rule, std::uint64_t seed, const StudyRunOptions& options,
                    const std::atomic<bool>& stop, const RunWatcher& watcher) {
  FailureSearch search(rule);
  auto badness = stored_badness(rule, store, index, search.numbers());
  MovesTogether together(prepared, rule, seed, options, stop);
  if (watcher.begin) watcher.begin(prepared.cell.name, search.numbers());
  StoreWriter writer(store);
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  std::atomic<std::uint32_t> made{0};
  while (!stop) {
    const auto moves = search.asked();
    if (moves.empty()) break;
    const bool all =
        together.run(search, moves, badness, [&](std::uint32_t trial, const Record& r) {
          ++made;
          writer.push(row_of(index, trial, r));
        });
    if (!all) break;
    std::vector<double> values;
    for (const auto& move : moves) values.push_back(badness[move.trial]);
    search.tell(values);
    if (!watcher.progress || made == 0) continue;
    const double per_s = made / std::chrono::duration<double>(Clock::now() - start).count();
    // Those left at most: runs that reach the failure end before.
    watcher.progress({.cell = prepared.cell.name,
                      .finished = search.trials(),
                      .trials = search.numbers(),
                      .trials_per_s = per_s,
                      .left_s = (search.numbers() - search.trials()) / per_s,
                      .widest = {}});
  }
  writer.finish();
  if (watcher.end) watcher.end();
}

}  // namespace

Study failure_study(const Study& study) {
  Study failures = study;
  failures.cells.clear();
  failures.designs.clear();
  std::string rules = study.digest;
  for (const auto& cell : study.cells) {
    if (!cell.failure) continue;
    const auto& rule = *cell.failure;
    rules += "\n" + text_of(rule, cell);
    for (const auto m : rule.methods) {
      Cell& one = failures.cells.emplace_back(cell);
      one.name = cell.name + "/" + cell.methods[m].id;
      one.methods = {cell.methods[m]};
      one.trials = rule.runs * plan_of(rule).numbers();
      one.stop.reset();
    }
  }
  failures.digest = digest(rules);
  return failures;
}

std::uint64_t failure_seed(const Study& study) { return study.seed ^ 0x6661696c75726521U; }

FailureSearch::FailureSearch(const FailureRule& rule) : plan_(plan_of(rule)) {
  for (std::uint32_t r = 0; r < rule.runs; ++r) runs_.emplace_back(plan_, r * plan_.numbers());
}

FailureSearch::FailureSearch(const FailureRule& rule, const Store& store, std::uint32_t cell)
    : FailureSearch(rule) {
  const auto badness = stored_badness(rule, store, cell, numbers());
  for (auto& run : runs_)
    while (!run.asked().empty()) {
      std::vector<double> values;
      for (const auto& move : run.asked()) values.push_back(badness[move.trial]);
      if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); })) break;
      run.tell(values);
    }
}

std::vector<SubsetMove> FailureSearch::asked() const {
  std::vector<SubsetMove> all;
  for (const auto& run : runs_) all.insert(all.end(), run.asked().begin(), run.asked().end());
  return all;
}

void FailureSearch::tell(std::span<const double> badness) {
  for (auto& run : runs_) {
    const std::size_t count = run.asked().size();
    if (count == 0) continue;
    run.tell(badness.first(count));
    badness = badness.subspan(count);
  }
}

std::uint32_t FailureSearch::trials() const {
  std::uint32_t sum = 0;
  for (const auto& run : runs_) sum += run.trials();
  return sum;
}

bool FailureSearch::reached() const {
  return std::all_of(runs_.begin(), runs_.end(),
                     [](const SubsetSimulation& run) { return run.reached(); });
}

PlainFailures plain_failures(const Store& store, std::uint32_t index, const Cell& cell,
                             std::size_t method) {
  PlainFailures plain;
  const auto& rule = *cell.failure;
  store.for_each_trial(index, cell.trials, [&](const Store::TrialView& trial) {
    const auto outcome = TrialOutcomes(trial.outcomes, cell.methods.size())[method];
    ++plain.trials;
    plain.failing += rule.badness(outcome.metric(rule.metric)) > rule.worst_allowed();
  });
  return plain;
}

void run_failures(const Study& study, const Store& plain, std::span<const RanCell> ran,
                  const std::filesystem::path& folder, const StudyRunOptions& options,
                  const std::atomic<bool>& stop, const RunWatcher& watcher) {
  const auto failures = failure_study(study);
  if (failures.cells.empty() || stop) return;
  if (options.shard.count > 1) {
    if (watcher.say) watcher.say("a shard looks for no rare failure; the merged run does");
    return;
  }
  std::optional<tbb::global_control> limit;
  if (options.threads > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism, options.threads);
  Store store = open_failure_store(folder / failure_folder, failures, options.mismatch, watcher);
  std::uint32_t index = 0;
  for (std::uint32_t c = 0; c < study.cells.size(); ++c) {
    const auto& cell = study.cells[c];
    if (!cell.failure) continue;
    const auto of_cell =
        std::find_if(ran.begin(), ran.end(), [&](const RanCell& r) { return r.index == c; });
    for (const auto m : cell.failure->methods) {
      const auto at = index++;
      if (stop || plain_failures(plain, c, cell, m).is_enough()) continue;
      auto prepared = of_cell != ran.end() ? of_cell->prepared
                                           : prepare_or_note(cell, study.seed, options.threads);
      prepared.cell.name = failures.cells[at].name;
      prepared.cell.methods = {prepared.cell.methods[m]};
      search_failure(store, at, prepared, *cell.failure, failure_seed(study), options, stop,
                     watcher);
    }
  }
}

}  // namespace gyrostat
