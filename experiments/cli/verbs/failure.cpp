#include <fmt/format.h>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/failures.hpp>
#include <gyrostat/experiments/run/study_store.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* failure_examples = R"(Examples:
  gyrostat failure runs/STUDY                    how likely each method fails, level by level
  gyrostat failure runs/STUDY --how              and what drives it: computed in seconds to minutes
  gyrostat replay STUDY:ramp:failure:kf --steps  the most likely failing signal, step by step)";

struct FailureArguments {
  std::string folder, cell;
  bool how = false;
  FormatOption format;
};

void add_drivers(const FailureArguments& arguments, const Study& study, std::uint32_t index,
                 const std::vector<FailureFinding>& findings, std::vector<Table>& tables) {
  const auto prepared = prepare_cell(study.cells[index], study.seed, 0);
  const auto& methods = study.cells[index].failure->methods;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (!findings[i].rare) continue;
    const auto how = how_it_fails(study, index, methods[i], prepared, arguments.folder);
    if (how)
      tables.push_back(driver_table(study, study.cells[index], findings[i], *how));
    else
      tables.back().notes.push_back(findings[i].method +
                                    ": failing trials have no deviates in common that fail alone");
  }
}

int run(const FailureArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const Store store = Store::open(arguments.folder);
  const auto study = stored_study(store);
  const Cell* only =
      arguments.cell.empty() ? nullptr : &cell_named(study, arguments.cell, "--cell");
  std::vector<Table> tables;
  for (std::uint32_t c = 0; c < study.cells.size(); ++c) {
    const auto& cell = study.cells[c];
    if (!cell.failure || (only && only != &cell)) continue;
    const auto findings = failure_findings(study, store, c, arguments.folder);
    tables.push_back(failure_table(cell, findings));
    if (auto levels = failure_levels(cell, findings); !levels.rows.empty())
      tables.push_back(std::move(levels));
    if (arguments.how) add_drivers(arguments, study, c, findings, tables);
  }
  if (tables.empty()) throw InputError(arguments.folder, no_failure_asked_for);
  console.out << render(tables, format);
  return complete;
}

}  // namespace

void add_failure(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "failure", "how likely each method of a run fails, however rare, and how it does");
  auto arguments = std::make_shared<FailureArguments>();
  verb->add_option("folder", arguments->folder, "folder of a run, as runs/<study>")->required();
  verb->add_option("--cell", arguments->cell, "this cell alone");
  verb->add_flag("--how", arguments->how,
                 "what drives each failure, and a second opinion on its probability");
  arguments->format.add_to(verb);
  verb->footer(failure_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
