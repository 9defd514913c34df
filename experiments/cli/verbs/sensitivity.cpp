#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/failure_sensitivity.hpp>
#include <gyrostat/experiments/findings/failures.hpp>
#include <gyrostat/experiments/findings/surrogate_json.hpp>
#include <gyrostat/experiments/run/study_store.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* sensitivity_examples = R"(Examples:
  gyrostat sensitivity runs/STUDY                         which parameter matters, for each method
  gyrostat sensitivity runs/STUDY --metric heading_end --method kf
  gyrostat sensitivity runs/STUDY --metric failure        what its failure's probability hangs on
  gyrostat sensitivity runs/STUDY --points --format csv   the mean at every point of the design
  gyrostat sensitivity runs/STUDY --json F.json           surrogates as functions of the parameters)";

struct SensitivityArguments {
  std::string folder;
  SensitivityChoice choice;
  bool points = false;
  std::string json;
  FormatOption format;
};

std::vector<Sensitivity> of_failure(const SensitivityArguments& arguments, const Study& study,
                                    const Store& store) {
  auto found = failure_sensitivities(study, store, arguments.folder);
  if (found.empty()) throw InputError(arguments.folder, no_failure_asked_for);
  const auto& method = arguments.choice.method;
  if (method.empty()) return found;
  std::vector<std::string> ids;
  for (const auto& s : found) ids.push_back(s.method);
  std::erase_if(found, [&](const Sensitivity& s) { return s.method != method; });
  if (found.empty()) throw InputError("--method", unknown_name("method", method, ids));
  return found;
}

int run(const SensitivityArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  if (!arguments.json.empty()) require_writable(arguments.json, "");
  const Store store = Store::open(arguments.folder);
  const Study study = stored_study(store);
  if (study.designs.empty())
    throw InputError(arguments.folder, "the study has no \"design\", so nothing was varied by one");
  const auto found = arguments.choice.metric == "failure"
                         ? of_failure(arguments, study, store)
                         : sensitivities(study, store, arguments.choice);
  if (!arguments.json.empty()) {
    if (std::none_of(found.begin(), found.end(), [](const auto& s) { return s.surrogate; }))
      throw InputError("--json", "the study has no design of kind surrogate, so there is none");
    write_atomically(arguments.json, surrogate_json(found, study));
  }
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
  verb->add_option(
      "--metric", arguments->choice.metric,
      "metric (default: the bias error), or failure: the logarithm of its probability");
  verb->add_option("--method", arguments->choice.method,
                   "method, by its id (default: all but the oracle)");
  verb->add_flag("--points", arguments->points, "the points and their means instead");
  verb->add_option("--json", arguments->json, "write surrogates as functions of the parameters")
      ->type_name("FILE");
  arguments->format.add_to(verb);
  verb->footer(sensitivity_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
