#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/cli/answer.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/progress.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/run_tables.hpp>
#include <gyrostat/experiments/run/failure_run.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/experiments/run/time_of_day.hpp>
#include <gyrostat/experiments/run/trials_together.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

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
Exit codes: 0 complete, 1 error, 2 usage, 3 failures over the budget, 4 stopped early: the same command goes on)";

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

/// Says what a run tells of itself: lines, and a bar for what is under way.
RunWatcher watcher_of(Console& console, std::optional<Progress>& bar) {
  return {.begin =
              [&](const std::string& name, std::uint32_t trials) {
                bar.emplace(console.log, console.log_is_terminal, name, trials);
              },
          .end = [&] { bar.reset(); },
          .progress = [&](const CellProgress& now) { bar->set(now.finished, to_text(now)); },
          .say = [&](const std::string& line) { console.log << line << '\n'; }};
}

/// How it ended: in words, in the log and as exit code.
int ended(StudyRun& run, const fs::path& folder, const Stopper& stopper, Console& console) {
  if (run.failed() > 0)
    console.log << fmt::format("{} failed; gyrostat status {} --failures says where\n",
                               counted(run.failed(), "trial"), folder.string());
  console.log << fmt::format("results: {} (tables.md, tables.json, outcomes.csv.gz)\n",
                             folder.string());
  const int code = run.over_budget() ? over_failure_budget : stopper.flag() ? stopped : complete;
  run.log().write("end", {{"exit_code", code}, {"failed", run.failed()}});
  if (code == over_failure_budget)
    console.log << fmt::format("failures over the budget: {} of {}, allowed are {:g} %\n",
                               run.failed(), counted(run.study().trials(), "trial"),
                               100.0 * run.study().failure_budget);
  if (code == stopped)
    console.log << stopper.reason()
                << ": the tables are of the trials that were done, and the same "
                   "command goes on from them\n";
  return code;
}

int run(const RunArguments& arguments, Console& console) {
  constexpr std::size_t most_shown = 40;
  const auto format = arguments.format.get();
  auto study = study_of(arguments);
  const auto shard = shard_of(arguments);
  const auto folder = folder_of(arguments, study, shard);
  std::optional<std::time_t> until;
  if (!arguments.until.empty()) until = next_time_of_day(arguments.until, std::time(nullptr));
  make_result_folder(folder);
  Stopper stopper(console.stop.orderly(StopSignal::Done::is_kept), until);
  std::optional<Progress> bar;
  const StudyRunOptions options{.shard = shard,
                                .threads = arguments.threads,
                                .lanes = arguments.lanes,
                                .mismatch = arguments.set_aside ? Mismatch::set_aside
                                            : arguments.mix     ? Mismatch::mix
                                                                : Mismatch::refuse};
  StudyRun run(std::move(study), folder, options, stopper, watcher_of(console, bar));
  try {
    const auto ran = run.run();
    run_failures(run.study(), run.store(), ran, folder, options, stopper.flag(),
                 watcher_of(console, bar));
    const auto tables = run_tables(run.study(), run.store(), ran, folder);
    write_results(folder, run.store(), tables);  // first, for who reads what is printed may leave
    const int code = ended(run, folder, stopper, console);
    print_answer(console, format, tables.answer);
    console.out << render(tables.with_points(most_shown), format);
    if (format == Format::text && !tables.timings.empty())
      console.out << '\n' << render(tables.timings, format);
    return code;
  } catch (const std::exception& failure) {
    run.log().write("error", {{"what", failure.what()}});
    throw;
  }
}

}  // namespace

void add_run(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand("run", "run a study, or go on with it where it ended");
  auto arguments = std::make_shared<RunArguments>();
  verb->add_option("study", arguments->study, "study file (JSON)")->required();
  verb->add_option("--out", arguments->out, "folder for the results (default: runs/<study>)");
  verb->add_option("--threads", arguments->threads, "threads (default: all)")
      ->check(whole(1, 1024));
  verb->add_option("--trials", arguments->trials, "trials of every cell, instead of the study's")
      ->check(whole(1, most_trials));
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
                   "trials side by side: 1, 2, 4, 8 or 16 (default: what is fastest here; the "
                   "same results)")
      ->check(CLI::Validator(
          [](const std::string& text) {
            return std::ranges::any_of(possible_lanes,
                                       [&](auto lanes) { return text == std::to_string(lanes); })
                       ? std::string{}
                       : "'" + text + "' is no number of lanes; allowed: 1, 2, 4, 8 or 16";
          },
          "1|2|4|8|16"));
  arguments->format.add_to(verb);
  verb->footer(run_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
