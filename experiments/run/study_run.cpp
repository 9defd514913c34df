#include <gyrostat/experiments/run/study_run.hpp>

#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/statistics/sequential.hpp>
#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/run/build.hpp>
#include <gyrostat/experiments/run/stopping.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat {
namespace {

using Clock = std::chrono::steady_clock;

/// Numbers of trials up to which a cell is run before its rule is asked.
std::vector<std::uint32_t> stages(const Cell& cell, bool looks) {
  auto limits =
      looks ? look_counts(cell.stop->at_least, cell.trials) : std::vector<std::uint32_t>{};
  if (limits.empty() || limits.back() < cell.trials) limits.push_back(cell.trials);
  return limits;
}

OutcomeSource outcomes_of(const Store& store, std::uint32_t cell, std::uint32_t limit) {
  return [&store, cell, limit](const auto& visit) {
    store.for_each_trial(cell, limit,
                         [&](const Store::TrialView& trial) { visit(trial.outcomes); });
  };
}

Json times_of(const Cell& cell, const std::vector<double>& nanoseconds) {
  Json times = Json::object();
  for (std::size_t m = 0; m < nanoseconds.size(); ++m)
    if (!std::isnan(nanoseconds[m]))
      times[cell.methods[m].id] = std::round(nanoseconds[m] * 10.0) / 10.0;
  return times;
}

}  // namespace

/// Cells that are told of as one: begun, and ended where it goes.
struct StudyRun::Stretch {
  static constexpr auto log_every = std::chrono::seconds(10);

  Stretch(const RunWatcher& told, const std::string& name, std::uint32_t finished,
          std::uint32_t trials, bool is_one_cell)
      : watcher(told),
        so_far{.cell = name, .finished = finished, .trials = trials, .widest = {}},
        before(finished),
        note_every(is_one_cell ? 0 : 1) {
    if (watcher.begin) watcher.begin(name, trials);
  }
  ~Stretch() {
    if (watcher.end) watcher.end();
  }
  Stretch(const Stretch&) = delete;
  Stretch& operator=(const Stretch&) = delete;

  /// Takes in how far one of its cells is.
  void set(std::uint32_t finished, std::uint32_t failed, const CellProgress& of_cell) {
    so_far.finished = finished;
    so_far.failed = failed;
    so_far.trials_per_s =
        (finished - before) / std::chrono::duration<double>(Clock::now() - start).count();
    so_far.left_s = (so_far.trials - finished) / so_far.trials_per_s;
    if (note_every.count() == 0) so_far.widest = of_cell.widest;
    if (watcher.progress) watcher.progress(so_far);
  }

  const RunWatcher& watcher;
  CellProgress so_far;
  std::uint32_t before;
  std::vector<double> nanoseconds{};
  std::chrono::seconds note_every;  ///< points are many and short
  Clock::time_point start = Clock::now(), noted = start, logged = start;
};

StudyRun::StudyRun(Study study, const std::filesystem::path& folder, const StudyRunOptions& options,
                   Stopper& stopper, RunWatcher watcher)
    : study_(std::move(study)),
      options_(options),
      stopper_(stopper),
      watcher_(std::move(watcher)),
      store_(open_study_store(folder, study_, options.mismatch)),
      log_(folder / "log.jsonl") {}

void StudyRun::say(const std::string& line) const {
  if (watcher_.say) watcher_.say(line);
}

bool StudyRun::over_budget() const {
  return static_cast<double>(failed_) >
         study_.failure_budget * static_cast<double>(study_.trials());
}

/// Reads, and so checks, all that the store holds before anything is added to it.
void StudyRun::read_states() {
  for (std::uint32_t c = 0; c < study_.cells.size(); ++c) {
    states_.emplace_back(store_, study_.cells[c], c, options_.shard);
    failed_ += store_.failed_trials(c, study_.cells[c].trials);
  }
}

std::vector<RanCell> StudyRun::run() {
  const auto build = build_for(study_);
  log_.write("start", {{"study", study_.name()},
                       {"digest", study_.digest},
                       {"build", build.version},
                       {"compiler", build.compiler},
                       {"flags", build.flags},
                       {"machine", this_machine()},
                       {"shard", options_.shard.index},
                       {"shards", options_.shard.count},
                       {"trials", study_.trials()}});
  if (options_.shard.count > 1)
    say(fmt::format("shard {} of {}", options_.shard.index, options_.shard.count));
  read_states();
  std::vector<RanCell> ran;
  for (std::uint32_t c = 0; c < study_.cells.size() && !stopper_.flag();) {
    const auto* design = design_of(study_, c);
    if (design == nullptr || !design->is_sampled()) {
      ran.push_back(run_cell(c++));
    } else {
      run_design(*design);
      c += static_cast<std::uint32_t>(design->values.size());
    }
  }
  return ran;
}

RanCell StudyRun::run_cell(std::uint32_t index) {
  auto& cell = study_.cells[index];
  auto& state = states_[index];
  RanCell ran{.index = index, .prepared = prepare_or_note(cell, study_.seed, options_.threads)};
  if (!ran.prepared.thrown.empty()) say(fmt::format("{}: {}", cell.name, ran.prepared.thrown));
  const bool looks = cell.stop && options_.shard.count == 1;
  if (cell.stop && !looks)
    say(cell.name + ": a shard runs all of its trials; its stop rule is for the merged run");
  for (const auto limit : stages(cell, looks)) {
    if (state.misses_below(limit)) {
      auto below = ran.prepared;
      below.cell.trials = limit;
      Stretch stretch(watcher_, cell.name, state.finished(), state.trials(), true);
      run_missing_of(index, below, stretch);
      ran.nanoseconds_per_step = std::move(stretch.nanoseconds);
    }
    if (stopper_.flag() || !looks) break;
    ran.stopped_by = stop_reason(cell, limit, outcomes_of(store_, index, limit));
    if (!ran.stopped_by) continue;
    cell.trials = limit;
    store_.set_cells(manifest_of(study_).cells);
    say(fmt::format("{}: stopped after {}: {}", cell.name, counted(limit, "trial"),
                    *ran.stopped_by));
    break;
  }
  log_.write("cell", {{"cell", cell.name},
                      {"failed", failed_},
                      {"stopped", ran.stopped_by.value_or("")},
                      {"ns_per_step", times_of(cell, ran.nanoseconds_per_step)}});
  return ran;
}

/// The points of a design, one after the other under one line of progress. They have no tables of
/// their own: those of the design say what came out.
void StudyRun::run_design(const Design& design) {
  const auto first = static_cast<std::uint32_t>(design.first_cell);
  const auto last = first + static_cast<std::uint32_t>(design.values.size());
  std::uint32_t finished = 0, trials = 0;
  for (auto c = first; c < last; ++c) {
    finished += states_[c].finished();
    trials += states_[c].trials();
  }
  if (finished < trials) {
    Stretch stretch(watcher_, design.name, finished, trials, false);
    stretch.so_far.failed = failed_;
    for (auto c = first; c < last && !stopper_.flag(); ++c)
      if (states_[c].missing() > 0)
        run_missing_of(c, prepare_or_note(study_.cells[c], study_.seed, options_.threads), stretch);
    store_.note_progress(to_json(stretch.so_far).dump());
  }
  log_.write("design",
             {{"design", design.name}, {"points", design.values.size()}, {"failed", failed_}});
}

void StudyRun::run_missing_of(std::uint32_t cell, const PreparedCell& prepared, Stretch& stretch) {
  const auto of_others = stretch.so_far.finished - states_[cell].finished();
  const auto failed_before = failed_;
  stretch.nanoseconds = run_missing(store_, prepared, cell, study_.seed, states_[cell],
                                    {.threads = options_.threads,
                                     .stop = &stopper_.flag(),
                                     .lanes = options_.lanes,
                                     .progress = {}},
                                    [&](const CellProgress& now) {
                                      failed_ = failed_before + now.failed;
                                      stretch.set(of_others + now.finished, failed_, now);
                                      if (over_budget())
                                        stopper_.stop("more failures than the budget allows");
                                      const auto time = Clock::now();
                                      if (time - stretch.noted >= stretch.note_every) {
                                        stretch.noted = time;
                                        store_.note_progress(to_json(stretch.so_far).dump());
                                      }
                                      if (time - stretch.logged >= Stretch::log_every) {
                                        stretch.logged = time;
                                        log_.write("progress", to_json(stretch.so_far));
                                      }
                                    });
}

}  // namespace gyrostat
