#include <gyrostat/experiments/findings/sensitivity.hpp>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/run/study_store.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* sensitivity_examples = R"(Examples:
  gyrostat sensitivity runs/STUDY                         which parameter matters, for each method
  gyrostat sensitivity runs/STUDY --metric heading_end --method kf
  gyrostat sensitivity runs/STUDY --points --format csv   the mean at every point of the design)";

struct SensitivityArguments {
  std::string folder;
  SensitivityChoice choice;
  bool points = false;
  FormatOption format;
};

int run(const SensitivityArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const Store store = Store::open(arguments.folder);
  const Study study = stored_study(store);
  if (study.designs.empty())
    throw InputError(arguments.folder, "the study has no \"design\", so nothing was varied by one");
  const auto found = sensitivities(study, store, arguments.choice);
  auto tables = sensitivity_tables(found, study);
  if (arguments.points || tables.empty()) tables = point_tables(found, study);
  console.out << render(tables, format);
  return complete;
}

}  // namespace

void add_sensitivity(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "sensitivity", "which parameter of a study's design matters: elasticities, Morris, Sobol'");
  auto arguments = std::make_shared<SensitivityArguments>();
  verb->add_option("folder", arguments->folder, "folder of a run, as runs/<study>")->required();
  verb->add_option("--metric", arguments->choice.metric, "metric (default: the bias error)");
  verb->add_option("--method", arguments->choice.method,
                   "method, by its id (default: all but the oracle)");
  verb->add_flag("--points", arguments->points, "the points and their means instead");
  arguments->format.add_to(verb);
  verb->footer(sensitivity_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
