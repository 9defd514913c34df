#include <fmt/format.h>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/experiments/run/trial.hpp>
#include <gyrostat/experiments/study/fleet.hpp>
#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/recordings/write_columns.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* simulate_examples = R"(Examples:
  gyrostat simulate STUDY.json --out REC.csv             trial 0 of the first cell
  gyrostat simulate STUDY.json --cell ramp --trial 3 --out REC.mat)";

struct SimulateArguments {
  std::string study;
  std::string cell;
  std::string out;
  std::uint32_t trial = 0;
};

int run(const SimulateArguments& arguments, Console& console) {
  const Study study = read_study(arguments.study);
  const Cell& cell = cell_named(study, arguments.cell, "--cell");
  require_writable(arguments.out, arguments.study);
  Series series;
  Scenario drawn;
  const auto& sensor = sensor_of(cell, {study.seed, arguments.trial}, drawn);
  synthesise(sensor, {study.seed, arguments.trial}, series);
  write_series(arguments.out, series);
  console.log << fmt::format("{}: trial {} of {}, {} samples\n", arguments.out, arguments.trial,
                             cell.name, series.size());
  if (cell.fleet) console.log << fmt::format("its sensor: {}\n", sensor_in_words(sensor));
  return complete;
}

}  // namespace

void add_simulate(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "simulate", "write the signal of one trial, with its truth, as a recording");
  auto arguments = std::make_shared<SimulateArguments>();
  verb->add_option("study", arguments->study, "study file (JSON)")->required();
  verb->add_option("--cell", arguments->cell, "cell of the study (default: the first)");
  verb->add_option("--trial", arguments->trial, "trial number, from 0")
      ->check(whole(0, most_trials))
      ->capture_default_str();
  verb->add_option("--out", arguments->out, "CSV, CSV.gz or MATLAB file to write")->required();
  verb->footer(simulate_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
