#include <gyrostat/experiments/findings/consistency.hpp>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/run/study_store.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* consistency_examples = R"(Examples:
  gyrostat consistency runs/STUDY                 does each filter's covariance tell the truth: every test
  gyrostat consistency runs/STUDY --cell ramp)";

struct ConsistencyArguments {
  std::string folder, cell;
  FormatOption format;
};

int run(const ConsistencyArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const Store store = Store::open(arguments.folder);
  const auto study = stored_study(store);
  const Cell* only =
      arguments.cell.empty() ? nullptr : &cell_named(study, arguments.cell, "--cell");
  std::vector<Table> tables;
  for (std::uint32_t c = 0; c < study.cells.size(); ++c) {
    const auto& cell = study.cells[c];
    if (only && only != &cell) continue;
    const auto summary = summarise_cell(cell, [&](const auto& visit) {
      store.for_each_trial(c, cell.trials, [&](const Store::TrialView& trial) {
        visit(trial.calibrated, trial.outcomes);
      });
    });
    for (auto& table : consistency_details(cell, summary)) tables.push_back(std::move(table));
  }
  console.out << render(tables, format);
  return complete;
}

}  // namespace

void add_consistency(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "consistency",
      "NIS, NEES, whiteness, PIT and 3 sigma of each filter of a run, with their bounds");
  auto arguments = std::make_shared<ConsistencyArguments>();
  verb->add_option("folder", arguments->folder, "folder of a run, as runs/<study>")->required();
  verb->add_option("--cell", arguments->cell, "this cell alone");
  arguments->format.add_to(verb);
  verb->footer(consistency_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
