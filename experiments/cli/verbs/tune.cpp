#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <gyrostat/analysis/error_metric.hpp>
#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/experiments/cli/answer.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/phase_progress.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/tuning_tables.hpp>
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
  std::string metric = "bias_rmse", by = "mean", cell, out, json;
  std::vector<std::string> methods, ranges;
  std::optional<double> above;
  TuningGoal goal;
  RunOptions run;
};

bool is_study(const std::string& file) { return fs::path(file).extension() == ".json"; }

/// One cell around the fit to a recording, as long as it is, with the methods that were named or
/// every contender for the random error.
Json study_around(const TuneArguments& arguments, std::ostream& log) {
  constexpr double longest_s = 600.0;
  const auto& input = arguments.input;
  const auto recording = input.read_all(log);
  const auto layout = input.layout();
  Json source = {{"file", fs::path(input.file).filename().string()}};
  if (!input.axis.empty()) source["axis"] = input.axis;
  if (!layout.columns.empty()) source["columns"] = layout.columns;
  if (!layout.units.empty()) source["units"] = layout.units;
  if (!input.preset.empty()) source["preset"] = input.preset;
  if (!input.topic.empty()) source["topic"] = input.topic;
  if (input.rate_hz > 0.0) source["rate_hz"] = input.rate_hz;
  if (input.resample_hz > 0.0) source["resample_hz"] = input.resample_hz;
  std::vector<std::string> filters = arguments.methods;
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
  auto study =
      is_study(file) ? read_study(file) : parse_study(study_around(arguments, console.log), file);
  if (!study.designs.empty())
    throw InputError(file,
                     "a cell with a \"design\" or a \"grid\" stands for many, which have no "
                     "values in common; tune the study without it");
  return study;
}

/// "phi=0.1:0.9"; at least one of the methods has the parameter, and the range is within its own.
std::pair<std::string, SearchRange> tuning_range(const std::string& text,
                                                 const std::vector<Method>& methods) {
  const auto equals = text.find('='), colon = text.find(':', equals);
  const std::string place = "--range " + text;
  SearchRange range;
  const auto read = [&](const std::string& word, double& value) {
    return CLI::detail::lexical_cast(word, value) && std::isfinite(value);
  };
  if (colon == std::string::npos || !read(text.substr(equals + 1, colon - equals - 1), range.low) ||
      !read(text.substr(colon + 1), range.high) || !(range.low < range.high))
    throw InputError(place, "a name and two bounds are needed, as phi=0.1:0.9");
  const auto name = text.substr(0, equals);
  std::vector<std::string> known;
  bool is_known = false;
  for (const auto& method : methods)
    for (const auto& field : method.type().fields) {
      known.emplace_back(field.name);
      if (field.name != name) continue;
      is_known = true;
      range.whole = field.range.whole;
      for (const double bound : {range.low, range.high})
        if (!field.range.contains(bound))
          throw InputError(place, fmt::format("{:g} {} is out of range; allowed of {}: {}", bound,
                                              field.unit, method.id, values_in_words(field.range)));
    }
  if (!is_known) throw InputError(place, unknown_name("parameter", name, known));
  return {name, range};
}

/// Which methods of a cell are tuned: those named; else those that the study gives a "tune"; else
/// every contender.
std::vector<std::size_t> methods_to_tune(const Cell& cell, const TuneArguments& arguments) {
  const bool any_tune = std::any_of(cell.methods.begin(), cell.methods.end(),
                                    [](const Method& m) { return !m.tune.empty(); });
  std::vector<std::size_t> chosen;
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    const auto& method = cell.methods[m];
    const auto& named = arguments.methods;
    const bool is_named = std::find(named.begin(), named.end(), method.id) != named.end();
    if (!named.empty() ? is_named : any_tune ? !method.tune.empty() : method.role().is_contender())
      chosen.push_back(m);
  }
  return chosen;
}

struct ToTune {
  std::size_t cell, method;
};

std::vector<ToTune> all_to_tune(const Study& study, const TuneArguments& arguments) {
  const Cell* only =
      arguments.cell.empty() ? nullptr : &cell_named(study, arguments.cell, "--cell");
  std::vector<ToTune> all;
  std::vector<std::string> ids;
  for (std::size_t c = 0; c < study.cells.size(); ++c) {
    if (only != nullptr && only != &study.cells[c]) continue;
    for (const auto& method : study.cells[c].methods) ids.push_back(method.id);
    for (const auto m : methods_to_tune(study.cells[c], arguments)) all.push_back({c, m});
  }
  for (const auto& name : arguments.methods)
    if (std::find(ids.begin(), ids.end(), name) == ids.end())
      throw InputError("--method", unknown_name("method", name, ids));
  if (all.empty()) throw InputError(arguments.input.file, "none of its methods can be tuned");
  return all;
}

TuningGoal goal_of(const TuneArguments& arguments, const Study& study,
                   const std::vector<ToTune>& all) {
  using Kind = TrialMeasure::Kind;
  TuningGoal goal = arguments.goal;
  goal.metric = error_metric_named(arguments.metric, "--metric");
  goal.measure = {.kind = arguments.above          ? Kind::probability
                          : arguments.by == "mean" ? Kind::mean
                                                   : Kind::cvar95,
                  .limit = arguments.above.value_or(0.0)};
  std::vector<Method> methods;
  for (const auto& [c, m] : all) methods.push_back(study.cells[c].methods[m]);
  for (const auto& text : arguments.ranges) goal.ranges.insert(tuning_range(text, methods));
  return goal;
}

std::vector<CellTuning> tune_all(const Study& study, const std::vector<ToTune>& all,
                                 const TuningGoal& goal, const RunOptions& options,
                                 Console& console) {
  std::vector<CellTuning> tunings;
  PhaseProgress progress(console.log, console.log_is_terminal, "tune");
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [c, m] = all[i];
    const auto& cell = study.cells[c];
    if (tunings.empty() || tunings.back().cell != c)
      tunings.push_back({.cell = c, .name = cell.name, .methods = {}});
    tunings.back().methods.push_back(
        tune_method(cell, m, study.seed, goal, options, [&](const std::string& what, double share) {
          progress.set(fmt::format("{}: {}", cell.name, what), "",
                       (static_cast<double>(i) + share) / static_cast<double>(all.size()));
        }));
  }
  return tunings;
}

int run(const TuneArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const auto& stop = console.stop.orderly();
  for (const auto& path : {arguments.out, arguments.json})
    if (!path.empty()) require_writable(path, arguments.input.file);
  const Study study = tuned_study(arguments, console);
  const auto all = all_to_tune(study, arguments);
  const auto goal = goal_of(arguments, study, all);
  auto options = arguments.run;
  options.stop = &stop;
  try {
    const auto tunings = tune_all(study, all, goal, options, console);
    if (!arguments.out.empty())
      write_atomically(arguments.out,
                       with_tuned_values(study, tunings, arguments.out).dump(2) + '\n');
    if (!arguments.json.empty())
      write_atomically(arguments.json, tuning_json(tunings, goal).dump(1) + '\n');
    print_answer(console, format, tuning_in_words(tunings, goal));
    console.out << render(tuning_tables(tunings, goal), format);
    return complete;
  } catch (const Interrupted&) {
    console.log << "stopped: nothing was written\n";
    return console.stop.exit_code();
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
  verb->add_option("--metric", arguments->metric, "error that is to be small")
      ->capture_default_str();
  auto* by = verb->add_option("--by", arguments->by, "mean of all trials, or of the worst 5 %")
                 ->check(CLI::IsMember({"mean", "cvar95"}))
                 ->capture_default_str();
  verb->add_option("--above", arguments->above,
                   "by the probability of an error above this, in its unit")
      ->check(within(0.0, HUGE_VAL))
      ->excludes(by);
  verb->add_option("--method", arguments->methods,
                   "these alone (default: those with a \"tune\", or every filter)")
      ->delimiter(',');
  verb->add_option("--cell", arguments->cell, "this cell alone");
  verb->add_option("--range", arguments->ranges,
                   "a parameter to tune with its bounds, instead of the study's or the default "
                   "ones; may stand several times")
      ->type_name("NAME=LOW:HIGH")
      ->allow_extra_args(false);
  verb->add_option("--budget", arguments->goal.budget,
                   "runs of a method over one trial, for its search")
      ->check(CLI::Range(std::size_t{400}, std::size_t{100'000'000}))
      ->capture_default_str();
  verb->add_option("--fresh", arguments->goal.fresh, "trials that judge what was found")
      ->check(CLI::Range(50U, 10'000'000U))
      ->capture_default_str();
  verb->add_option("--out", arguments->out, "write the study with the values that are better")
      ->type_name("STUDY.json");
  verb->add_option("--json", arguments->json, "write all that was found")->type_name("FILE");
  verb->add_option("--threads", arguments->run.threads, "threads (default: all)")
      ->check(CLI::Range(1, 1024));
  arguments->format.add_to(verb);
  verb->footer(tune_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
