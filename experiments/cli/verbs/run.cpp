#include <cstdlib>
#include <filesystem>

#include <gyrostat/analysis/statistics/sequential.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/progress.hpp>
#include <gyrostat/experiments/cli/stopper.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/error_tables.hpp>
#include <gyrostat/experiments/findings/ranking.hpp>
#include <gyrostat/experiments/findings/sensitivity.hpp>
#include <gyrostat/experiments/run/build.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/experiments/run/run_log.hpp>
#include <gyrostat/experiments/run/stopping.hpp>
#include <gyrostat/experiments/run/stored_run.hpp>
#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/experiments/run/time_of_day.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* run_examples = R"(Examples:
  gyrostat run STUDY.json                   to runs/STUDY; the same again goes on where it ended
  gyrostat run STUDY.json --trials 100000   adds trials to those that are there
  gyrostat run STUDY.json --until 07:00     stops in good order, and goes on the next evening
  gyrostat run STUDY.json --shard 2/8       one of eight parts; gyrostat merge puts them together
  gyrostat run STUDY.json --stop '{"half_width_below": 0.001}'     until every mean is known so well
  gyrostat run STUDY.json --stop '{"separate": ["kf", "stf"]}'     until these two are told apart
Exit codes: 0 complete, 1 error, 2 usage, 3 failures over the budget, 4 stopped, to be resumed)";

struct RunArguments {
  std::string study, out, shard, until, stop;
  FormatOption format;
  int threads = 0;
  std::uint32_t trials = 0;
  double failure_budget = -1.0;
  bool mix = false, set_aside = false;
  std::uint32_t lanes = default_lanes();
};

Study study_of(const RunArguments& arguments) {
  Mistakes mistakes;
  Json json = read_json(arguments.study, &mistakes);
  if (!arguments.stop.empty()) json = with_stop(std::move(json), arguments.stop);
  Study study = parse_study(json, arguments.study, std::move(mistakes));
  if (arguments.trials > 0) set_trials(study, arguments.trials);
  if (arguments.failure_budget >= 0.0) study.failure_budget = arguments.failure_budget;
  return study;
}

Shard shard_of(const RunArguments& arguments) {
  if (!arguments.shard.empty()) return parse_shard(arguments.shard);
  return slurm_shard([](const char* name) { return std::getenv(name); }).value_or(Shard{});
}

fs::path folder_of(const RunArguments& arguments, const Study& study, const Shard& shard) {
  if (!arguments.out.empty()) return arguments.out;
  const auto folder = fs::path("runs") / study.name();
  return shard.count == 1 ? folder : folder / shard.folder();
}

/// A study on its way through the store.
class Run {
 public:
  Run(const RunArguments& arguments, Console& console)
      : console_(console),
        format_(arguments.format.get()),
        study_(study_of(arguments)),
        shard_(shard_of(arguments)),
        folder_(folder_of(arguments, study_, shard_)),
        threads_(arguments.threads),
        lanes_(arguments.lanes) {
    if (!arguments.until.empty()) until_ = next_time_of_day(arguments.until, std::time(nullptr));
    make_result_folder(folder_);
    store_.emplace(open_study_store(folder_, study_,
                                    arguments.set_aside ? Mismatch::set_aside
                                    : arguments.mix     ? Mismatch::mix
                                                        : Mismatch::refuse));
    log_.emplace(folder_ / "log.jsonl");
  }

  int operator()() {
    try {
      return run();
    } catch (const std::exception& failure) {
      log_->write("error", {{"what", failure.what()}});
      throw;
    }
  }

 private:
  int run() {
    const auto build = this_build();
    log_->write("start", {{"study", study_.name()},
                          {"digest", study_.digest},
                          {"build", build.version},
                          {"compiler", build.compiler},
                          {"flags", build.flags},
                          {"machine", this_machine()},
                          {"shard", shard_.index},
                          {"shards", shard_.count},
                          {"trials", study_.trials()}});
    if (shard_.count > 1)
      console_.log << fmt::format("shard {} of {}\n", shard_.index, shard_.count);
    Stopper stopper(console_, until_);
    auto states = read_states();
    for (std::uint32_t c = 0; c < study_.cells.size() && !stopper.flag();) {
      const auto* design = design_of(study_, c);
      if (design == nullptr || !design->is_sampled()) {
        run_cell(c, states[c], stopper);
        ++c;
      } else {
        run_design(*design, states, stopper);
        c += static_cast<std::uint32_t>(design->values.size());
      }
    }
    add_design_tables();
    write_results();
    return end(stopper);
  }

  /// Reads, and so checks, all that the store holds before anything is added to it.
  std::vector<CellState> read_states() {
    std::vector<CellState> states;
    for (std::uint32_t c = 0; c < study_.cells.size(); ++c) {
      states.emplace_back(*store_, study_.cells[c], c, shard_);
      failed_ += store_->failed_trials(c, study_.cells[c].trials);
    }
    return states;
  }

  void run_cell(std::uint32_t index, CellState& state, Stopper& stopper) {
    auto& cell = study_.cells[index];
    const auto prepared = prepare_cell(cell, study_.seed, threads_);
    const bool looks = cell.stop && shard_.count == 1;
    if (cell.stop && !looks)
      console_.log << cell.name
                   << ": a shard runs all of its trials; its stop rule is for the merged run\n";
    std::vector<double> nanoseconds;
    std::optional<std::string> reason;
    for (const auto limit : stages(cell, looks)) {
      run_trials_below(limit, index, prepared, state, stopper, nanoseconds);
      if (stopper.flag() || !looks) break;
      reason = stop_reason(cell, limit, outcomes_of(index, limit));
      if (!reason) continue;
      cell.trials = limit;
      store_->set_cells(manifest_of(study_).cells);
      console_.log << fmt::format("{}: stopped after {} trials: {}\n", cell.name, limit, *reason);
      break;
    }
    Json times = Json::object();
    for (std::size_t m = 0; m < nanoseconds.size(); ++m)
      if (!std::isnan(nanoseconds[m]))
        times[cell.methods[m].id] = std::round(nanoseconds[m] * 10.0) / 10.0;
    log_->write("cell", {{"cell", cell.name},
                         {"failed", failed_},
                         {"stopped", reason.value_or("")},
                         {"ns_per_step", times}});
    summarise(index, prepared, nanoseconds, reason);
  }

  /// Numbers of trials up to which a cell is run before its rule is asked.
  static std::vector<std::uint32_t> stages(const Cell& cell, bool looks) {
    auto limits =
        looks ? look_counts(cell.stop->at_least, cell.trials) : std::vector<std::uint32_t>{};
    if (limits.empty() || limits.back() < cell.trials) limits.push_back(cell.trials);
    return limits;
  }

  void run_trials_below(std::uint32_t limit, std::uint32_t index, PreparedCell prepared,
                        CellState& state, Stopper& stopper, std::vector<double>& nanoseconds) {
    if (!state.misses_below(limit)) return;
    prepared.cell.trials = limit;
    Progress progress(console_.log, console_.log_is_terminal, prepared.cell.name, state.trials());
    const auto failed_before = failed_;
    auto logged = std::chrono::steady_clock::now();
    const auto watch = [&](CellProgress now) {
      now.failed = failed_ = failed_before + now.failed;
      progress.set(now.finished, to_text(now));
      store_->note_progress(to_json(now).dump());
      if (over_budget()) stopper.stop("more failures than the budget allows");
      constexpr auto log_every = std::chrono::seconds(10);
      if (const auto time = std::chrono::steady_clock::now(); time - logged >= log_every) {
        logged = time;
        log_->write("progress", to_json(now));
      }
    };
    nanoseconds = run_missing(
        *store_, prepared, index, study_.seed, state,
        {.threads = threads_, .stop = &stopper.flag(), .lanes = lanes_, .progress = {}}, watch);
  }

  OutcomeSource outcomes_of(std::uint32_t index, std::uint32_t limit) const {
    return [this, index, limit](const auto& visit) {
      store_->for_each_trial(index, limit,
                             [&](const Store::TrialView& trial) { visit(trial.outcomes); });
    };
  }

  /// The points of a design, one after the other under one line of progress. They have no tables of
  /// their own: those of the design say what came out.
  void run_design(const Design& design, std::vector<CellState>& states, Stopper& stopper) {
    using Clock = std::chrono::steady_clock;
    const auto first = static_cast<std::uint32_t>(design.first_cell);
    const auto last = first + static_cast<std::uint32_t>(design.values.size());
    CellProgress whole{
        .cell = design.name, .finished = 0, .trials = 0, .failed = failed_, .widest = {}};
    for (auto c = first; c < last; ++c) {
      whole.finished += states[c].finished();
      whole.trials += states[c].trials();
    }
    if (whole.finished < whole.trials) {
      Progress progress(console_.log, console_.log_is_terminal, design.name, whole.trials);
      const auto before = whole.finished;
      const auto start = Clock::now();
      auto logged = start, noted = start;
      for (auto c = first; c < last && !stopper.flag(); ++c) {
        if (states[c].missing() == 0) continue;
        const auto done = whole.finished - states[c].finished();
        const auto failed_before = failed_;
        const auto prepared = prepare_cell(study_.cells[c], study_.seed, threads_);
        run_missing(*store_, prepared, c, study_.seed, states[c],
                    {.threads = threads_, .stop = &stopper.flag(), .lanes = lanes_, .progress = {}},
                    [&](const CellProgress& now) {
                      whole.failed = failed_ = failed_before + now.failed;
                      whole.finished = done + now.finished;
                      whole.trials_per_s =
                          (whole.finished - before) /
                          std::chrono::duration<double>(Clock::now() - start).count();
                      whole.left_s = (whole.trials - whole.finished) / whole.trials_per_s;
                      progress.set(whole.finished, to_text(whole));
                      if (over_budget()) stopper.stop("more failures than the budget allows");
                    });
        constexpr auto note_every = std::chrono::seconds(1), log_every = std::chrono::seconds(10);
        if (Clock::now() - noted >= note_every) {
          noted = Clock::now();
          store_->note_progress(to_json(whole).dump());
        }
        if (Clock::now() - logged >= log_every) {
          logged = Clock::now();
          log_->write("progress", to_json(whole));
        }
      }
      store_->note_progress(to_json(whole).dump());
    }
    log_->write("design",
                {{"design", design.name}, {"points", design.values.size()}, {"failed", failed_}});
  }

  /// What the designs say; many points are for the files alone.
  void add_design_tables() {
    Study sampled = study_;
    std::erase_if(sampled.designs, [](const Design& design) { return !design.is_sampled(); });
    if (sampled.designs.empty()) return;
    const auto found = sensitivities(sampled, *store_);
    for (auto& table : sensitivity_tables(found, sampled)) tables_.push_back(std::move(table));
    points_ = point_tables(found, sampled);
  }

  void summarise(std::uint32_t index, const PreparedCell& prepared,
                 const std::vector<double>& nanoseconds,
                 const std::optional<std::string>& stopped_by) {
    const auto& cell = study_.cells[index];
    const TrialSource trials = [&](const auto& visit) {
      store_->for_each_trial(index, cell.trials, [&](const Store::TrialView& trial) {
        visit(trial.calibrated, trial.outcomes);
      });
    };
    const auto summary = summarise_cell(cell, trials);
    if (cell.needs_calibration())
      tables_.push_back(calibration_table(cell, prepared.calibration, summary));
    if (auto tuning = tuning_table(cell, prepared.tuned); !tuning.rows.empty())
      tables_.push_back(std::move(tuning));
    auto errors = error_tables(cell, summary);
    if (stopped_by)
      errors.front().notes.push_back(
          fmt::format("stopped by its rule after {} trials: {}", cell.trials, *stopped_by));
    for (auto& table : errors) tables_.push_back(std::move(table));
    if (cell.methods.size() > 1) tables_.push_back(ranking_table(rank_cell(cell, trials)));
    if (!nanoseconds.empty()) timings_.push_back(timing_table(cell, nanoseconds));
  }

  void write_results() {
    const auto all = with_points(most_files);
    console_.out << render(with_points(most_shown), format_) << std::flush;
    if (format_ == Format::text && !timings_.empty())
      console_.out << '\n' << render(timings_, format_);
    write_outcomes(folder_ / "outcomes.csv.gz", *store_);
    write_atomically(folder_ / "tables.json", render(all, Format::json));
    write_atomically(folder_ / "tables.md", render(all, Format::markdown));
  }

  static constexpr std::size_t most_shown = 40, most_files = 1000000;

  /// All tables, with those of designs' points that have no more than `most` rows.
  std::vector<Table> with_points(std::size_t most) const {
    auto tables = tables_;
    for (const auto& points : points_)
      if (points.rows.size() <= most) tables.push_back(points);
    return tables;
  }

  bool over_budget() const {
    return static_cast<double>(failed_) >
           study_.failure_budget * static_cast<double>(study_.trials());
  }

  int end(const Stopper& stopper) {
    if (failed_ > 0)
      console_.log << fmt::format(
          "{} trials failed; gyrostat status {} --failures has their addresses\n", failed_,
          folder_.string());
    console_.log << fmt::format("results: {} (tables.md, tables.json, outcomes.csv.gz)\n",
                                folder_.string());
    const int code = over_budget() ? over_failure_budget : stopper.flag() ? stopped : complete;
    log_->write("end", {{"exit_code", code}, {"failed", failed_}});
    if (code == over_failure_budget)
      console_.log << fmt::format("failures over the budget: {} of {} trials, allowed are {:g} %\n",
                                  failed_, study_.trials(), 100.0 * study_.failure_budget);
    if (code == stopped)
      console_.log << stopper.reason()
                   << ": the tables are of the trials that were done, and the same "
                      "command goes on from them\n";
    return code;
  }

  Console& console_;
  Format format_;
  Study study_;
  Shard shard_;
  fs::path folder_;
  int threads_;
  std::uint32_t lanes_;
  std::optional<std::time_t> until_;
  std::optional<Store> store_;
  std::optional<RunLog> log_;
  std::vector<Table> tables_, points_, timings_;
  std::uint32_t failed_ = 0;
};

}  // namespace

void add_run(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand("run", "run a study, or go on with it where it ended");
  auto arguments = std::make_shared<RunArguments>();
  verb->add_option("study", arguments->study, "study file (JSON)")->required();
  verb->add_option("--out", arguments->out, "folder for the results (default: runs/<study>)");
  verb->add_option("--threads", arguments->threads, "threads (default: all)")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--trials", arguments->trials, "trials of every cell, instead of the study's")
      ->check(CLI::Range(1U, 4294967295U));
  verb->add_option("--shard", arguments->shard,
                   "run only the trials of part i of n (in a Slurm job array: the task's own)");
  verb->add_option(
      "--stop", arguments->stop,
      "rule by which cells stop before all trials are run, instead of the study's; none");
  verb->add_option("--until", arguments->until, "stop in good order at this time of day, as 07:00");
  verb->add_option("--failure-budget", arguments->failure_budget,
                   "share of the trials that may fail, instead of the study's")
      ->check(within(0.0, 1.0));
  auto* mix =
      verb->add_flag("--mix", arguments->mix,
                     "go on in a folder begun by another build or before the study was changed");
  verb->add_flag("--set-aside", arguments->set_aside,
                 "keep the outcomes that are there under another name and begin anew")
      ->excludes(mix);
  verb->add_option("--lanes", arguments->lanes,
                   "trials side by side: 1, 2, 4 or 8 (default: as many as a register holds; the "
                   "same results)")
      ->check(CLI::IsMember(possible_lanes));
  arguments->format.add_to(verb);
  verb->footer(run_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = Run(*arguments, console)(); });
}

}  // namespace gyrostat::cli
