#include <gyrostat/experiments/pages/ledger.hpp>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/progress.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* ledger_examples = R"(Examples:
  gyrostat ledger LEDGER.json
  gyrostat ledger LEDGER.json --trials 50 --format md)";

struct LedgerArguments {
  std::string ledger;
  std::uint32_t trials = 0;
  FormatOption format;
};

int run(const LedgerArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const Ledger ledger = read_ledger(arguments.ledger);
  const auto findings = judge(ledger, [&](const Study& study, const Cell& cell) {
    Cell shown = cell;
    if (arguments.trials > 0 && !cell.recording) shown.trials = arguments.trials;
    Progress progress(console.log, console.log_is_terminal, cell.name, shown.trials);
    return run_cell(shown, study.seed, {.progress = [&](std::size_t done) { progress.set(done); }});
  });
  console.out << render(ledger_tables(ledger, findings), format);
  return complete;
}

}  // namespace

void add_ledger(CLI::App& program, Console& console, int& exit_code) {
  auto* verb =
      program.add_subcommand("ledger", "decide claims by trials: holds, holds only where, not");
  auto arguments = std::make_shared<LedgerArguments>();
  verb->add_option("ledger", arguments->ledger, "ledger file (JSON)")->required();
  verb->add_option("--trials", arguments->trials, "trials of every cell, instead of the study's")
      ->check(whole(2, most_trials));
  arguments->format.add_to(verb);
  verb->footer(ledger_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
