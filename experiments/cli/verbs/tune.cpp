#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/experiments/cli/answer.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/phase_progress.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/study_tuning.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* tune_examples = R"(Examples:
  gyrostat tune STUDY.json --out TUNED.json           the study with the tuned values
  gyrostat tune STUDY.json --by cvar95                for the worst 5 % of trials
  gyrostat tune STUDY.json --above 0.05               for the probability of an error above 0.05
  gyrostat tune STUDY.json --method stf --range softening=1:50 --range forgetting=0.5:1
  gyrostat tune REC.csv --method kf,stf               on trials around the fit to a recording)";

struct TuneArguments {
  RecordingOption input;
  FormatOption format;
  std::string out, json;
  TuningRequest request;
  RunOptions run;
};

bool is_study(const std::string& file) { return fs::path(file).extension() == ".json"; }

/// One cell around the fit to a recording, as long as it is, with the methods that were named or
/// every contender for the random error.
Json study_around(const TuneArguments& arguments, std::ostream& log) {
  constexpr double longest_s = 600.0;
  const auto& input = arguments.input;
  const auto recording = input.read_all(log);
  const auto source = input.source_for(fs::path(input.file).parent_path());
  std::vector<std::string> filters = arguments.request.methods;
  if (filters.empty())
    for (const auto& method : all_methods(ParameterSource::calibration))
      if (method.role().is_contender() && method.role().corrects == Role::Corrects::random_error)
        filters.push_back(method.id);
  return {{"title", "around " + source["file"].get<std::string>()},
          {"cells",
           {{{"name", "around the recording"},
             {"scenario",
              {{"from_recording", source},
               {"duration_s", std::min(longest_s, recording.series.duration_s())}}},
             {"filters", filters}}}}};
}

Study tuned_study(const TuneArguments& arguments, Console& console) {
  const auto& file = arguments.input.file;
  return is_study(file) ? read_study(file)
                        : parse_study(study_around(arguments, console.log), file);
}

int run(const TuneArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const auto& stop = console.stop.orderly(StopSignal::Done::is_discarded);
  for (const auto& path : {arguments.out, arguments.json})
    if (!path.empty()) require_writable(path, arguments.input.file);
  const Study study = tuned_study(arguments, console);
  auto options = arguments.run;
  options.stop = &stop;
  try {
    std::optional<PhaseProgress> progress(std::in_place, console.log, console.log_is_terminal,
                                          "tune");
    const auto [goal, tunings] =
        tune_study(study, arguments.request, options,
                   [&](const std::string& what, double share) { progress->set(what, "", share); });
    progress.reset();
    if (!arguments.out.empty())
      write_atomically(arguments.out,
                       with_tuned_values(study, tunings, arguments.out).dump(2) + '\n');
    if (!arguments.json.empty())
      write_atomically(arguments.json, tuning_json(tunings, goal).dump(1) + '\n');
    print_answer(console, format, tuning_in_words(tunings, goal));
    console.out << render(tuning_tables(tunings, goal), format);
    return complete;
  } catch (const Interrupted&) {
    console.log << "stopped early: nothing was written\n";
    return stopped;
  }
}

}  // namespace

void add_tune(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "tune", "the best parameters of each method, judged on trials that no search has seen");
  auto arguments = std::make_shared<TuneArguments>();
  arguments->input.add_to(verb);
  verb->get_option("recording")
      ->description(
          "study file (.json), or a recording: its methods are tuned around the fit to it");
  verb->add_option("--metric", arguments->request.metric, "error that is to be small")
      ->capture_default_str();
  auto* by =
      verb->add_option("--by", arguments->request.by, "mean of all trials, or of the worst 5 %")
          ->check(CLI::IsMember({"mean", "cvar95"}))
          ->capture_default_str();
  verb->add_option("--above", arguments->request.above,
                   "by the probability of an error above this, in its unit")
      ->check(within(0.0, HUGE_VAL))
      ->excludes(by);
  verb->add_option("--method", arguments->request.methods,
                   "these alone (default: those with a \"tune\", or every filter)")
      ->delimiter(',');
  verb->add_option("--cell", arguments->request.cell, "this cell alone");
  verb->add_option("--range", arguments->request.ranges,
                   "a parameter to tune with its bounds, instead of the study's or the default "
                   "ones; may stand several times")
      ->type_name("NAME=LOW:HIGH")
      ->allow_extra_args(false);
  verb->add_option("--budget", arguments->request.goal.budget,
                   "runs of a method over one trial, for its search")
      ->check(whole(400, 100'000'000))
      ->capture_default_str();
  verb->add_option("--fresh", arguments->request.goal.fresh, "trials that judge what was found")
      ->check(whole(50, 10'000'000))
      ->capture_default_str();
  verb->add_option("--out", arguments->out, "write the study with the values that are better")
      ->type_name("STUDY.json");
  verb->add_option("--json", arguments->json, "write all that was found")->type_name("FILE");
  verb->add_option("--threads", arguments->run.threads, "threads (default: all)")
      ->check(whole(1, 1024));
  arguments->format.add_to(verb);
  verb->footer(tune_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
