#include <gyrostat/experiments/coverage/coverage.hpp>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/progress.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* coverage_examples = R"(Examples:
  gyrostat coverage experiments/studies/coverage.json    how often each 95 % interval holds what it is for)";

struct CoverageArguments {
  std::string study;
  FormatOption format;
};

int run(const CoverageArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const auto study = read_coverage(arguments.study);
  const auto coverages = measure_coverage(study, [&](const Study& cells, const Cell& cell) {
    Progress progress(console.log, console.log_is_terminal, cell.name, cell.trials);
    return run_cell(cell, cells.seed, {.progress = [&](std::size_t done) { progress.set(done); }});
  });
  const auto table = coverage_table(study, coverages);
  console.out << render({&table, 1}, format);
  return complete;
}

}  // namespace

void add_coverage(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand("coverage", "measure how often the program's intervals hold");
  auto arguments = std::make_shared<CoverageArguments>();
  verb->add_option("study", arguments->study, "coverage study (JSON)")->required();
  arguments->format.add_to(verb);
  verb->footer(coverage_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
