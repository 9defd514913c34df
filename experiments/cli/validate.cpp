#include "experiments/cli/options.hpp"
#include "experiments/cli/verbs.hpp"
#include "experiments/study.hpp"

namespace gyrostat::cli {
namespace {

constexpr const char* examples = R"(Examples:
  gyrostat validate STUDY.json     all of its mistakes, or what it would run)";

int run(const std::string& path, Console& console) {
  const Study study = read_study(path);
  console.out << fmt::format("{}: sound. \"{}\", seed {}\n", path, study.title, study.seed);
  for (const auto& cell : study.cells) {
    std::vector<std::string> ids;
    for (const auto& method : cell.methods) ids.push_back(method.id);
    console.out << fmt::format("  {}: {} trials of {} samples, methods {}\n", cell.name, cell.trials,
                               cell.scenario.sampling.samples(), fmt::join(ids, ", "));
  }
  return complete;
}

}  // namespace

void add_validate(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand("validate", "check a study file and say what it would run");
  auto study = std::make_shared<std::string>();
  verb->add_option("study", *study, "study file (JSON)")->required();
  verb->footer(examples);
  verb->callback([study, &console, &exit_code] { exit_code = run(*study, console); });
}

}  // namespace gyrostat::cli
