#include <filesystem>

#include "experiments/atomic_file.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/cli/progress.hpp"
#include "experiments/cli/verbs.hpp"
#include "experiments/error_tables.hpp"
#include "experiments/outcome_file.hpp"

namespace gyrostat::cli {
namespace {

struct RunArguments {
  std::string study;
  std::string out;
  FormatOption format;
  int threads = 0;
  std::uint32_t trials = 0;
  std::uint32_t lanes = default_lanes;
};

int run(const RunArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  Study study = read_study(arguments.study);
  if (arguments.trials > 0)
    for (auto& cell : study.cells)
      cell.trials = cell.recording ? std::min(cell.trials, arguments.trials) : arguments.trials;

  const std::filesystem::path folder =
      arguments.out.empty() ? std::filesystem::path("runs") /
                                  std::filesystem::path(arguments.study).stem()
                            : std::filesystem::path(arguments.out);
  make_result_folder(folder);

  std::vector<Table> tables, timings;
  std::vector<CellResult> results;
  for (const auto& cell : study.cells) {
    if (console.stop) break;
    {
      Progress progress(console.log, console.log_is_terminal, cell.name, cell.trials);
      results.push_back(run_cell(cell, study.seed,
                                 {.threads = arguments.threads,
                                  .stop = &console.stop,
                                  .lanes = arguments.lanes,
                                  .progress = [&](std::size_t done) { progress.set(done); }}));
    }
    if (cell.needs_calibration()) tables.push_back(calibration_table(cell, results.back()));
    if (auto tuning = tuning_table(cell, results.back()); !tuning.rows.empty())
      tables.push_back(std::move(tuning));
    for (auto& table : error_tables(cell, results.back())) tables.push_back(std::move(table));
    timings.push_back(timing_table(cell, results.back()));
  }

  console.out << render(tables, format) << std::flush;
  if (format == Format::text) console.out << '\n' << render(timings, format);
  write_outcomes(folder / "outcomes.csv.gz", study, results);
  write_atomically(folder / "tables.json", render(tables, Format::json));
  write_atomically(folder / "tables.md", render(tables, Format::markdown));
  console.log << fmt::format("results: {} (tables.md, tables.json, outcomes.csv.gz)\n",
                             folder.string());
  if (!console.stop) return complete;
  console.log << "stopped early: the tables are of the trials that were done\n";
  return stopped;
}

}  // namespace

void add_run(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand("run", "run a study: thousands of trials of every filter");
  auto arguments = std::make_shared<RunArguments>();
  verb->add_option("study", arguments->study, "study file (JSON)")->required();
  verb->add_option("--out", arguments->out, "folder for the results (default: runs/<study>)");
  verb->add_option("--threads", arguments->threads, "threads (default: all)")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--trials", arguments->trials, "trials of every cell, instead of the study's")
      ->check(CLI::Range(1U, 4294967295U));
  verb->add_option("--lanes", arguments->lanes, "trials side by side: 1, 2, 4 or 8 (the same results)")
      ->check(CLI::IsMember(possible_lanes));
  arguments->format.add_to(verb);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
