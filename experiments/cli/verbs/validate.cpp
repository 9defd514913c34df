#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/study/fleet.hpp>
#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* validate_examples = R"(Examples:
  gyrostat validate STUDY.json     all of its mistakes, or what it would run)";

/// A design on one line: "sweep, saltelli of 768 points over phi, delta1_dps".
std::string described(const Design& design) {
  std::vector<std::string> names;
  for (const auto& parameter : design.parameters) names.push_back(parameter.name);
  return fmt::format("{}, {} of {} over {}", design.name, name_of(design.kind),
                     counted(design.values.size(), "point"), fmt::join(names, ", "));
}

int run(const std::string& path, Console& console) {
  const Study study = read_study(path);
  console.out << wrapped(fmt::format("{}: sound. \"{}\", seed {}", path, study.title, study.seed),
                         2);
  for (std::size_t c = 0; c < study.cells.size(); ++c) {
    const auto& cell = study.cells[c];
    const auto* design = design_of(study, c);
    const bool sampled = design != nullptr && design->is_sampled();
    std::vector<std::string> ids;
    for (const auto& method : cell.methods) ids.push_back(method.id);
    console.out << wrapped(
        fmt::format("  {}: {} of {}, methods {}", sampled ? described(*design) : cell.name,
                    counted(cell.trials, "trial"),
                    counted(cell.scenario.sampling.samples(), "sample"), fmt::join(ids, ", ")),
        2);
    if (cell.fleet)
      console.out << fmt::format(
          "    sensors drawn from {}, {} of draws beyond a range and redrawn\n",
          counted(cell.fleet->units().size(), "unit"),
          fmt::format("{:.2g} %", 100.0 * cell.fleet->redrawn()));
    if (sampled) c += design->values.size() - 1;
  }
  return complete;
}

}  // namespace

void add_validate(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand("validate", "check a study file and say what it would run");
  auto study = std::make_shared<std::string>();
  verb->add_option("study", *study, "study file (JSON)")->required();
  verb->footer(validate_examples);
  verb->callback([study, &console, &exit_code] { exit_code = run(*study, console); });
}

}  // namespace gyrostat::cli
