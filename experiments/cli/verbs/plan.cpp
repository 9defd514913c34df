#include <gyrostat/experiments/findings/plan.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <unistd.h>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/recordings/temporary_folder.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* plan_examples = R"(Examples:
  gyrostat plan STUDY.json                    how long a run will take here, and how much disk
  gyrostat plan STUDY.json --trials 1000000
  gyrostat plan STUDY.json --shards 100       how long each of 100 shards will take)";

struct PlanArguments {
  std::string study;
  FormatOption format;
  PilotOptions pilot;
  std::uint32_t trials = 0;
  int shards = 1;
};

std::string duration(double seconds) {
  const auto s = static_cast<std::int64_t>(std::llround(seconds));
  if (seconds < 10.0) return fmt::format("{:.1f} s", seconds);
  if (s < 120) return fmt::format("{} s", s);
  if (s < 7200) return fmt::format("{} min {} s", s / 60, s % 60);
  if (s < 172800) return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
  return fmt::format("{} d {} h", s / 86400, s / 3600 % 24);
}

/// A cell of its own, or a design with all of its points, and what that will cost.
struct PlannedPart {
  std::string name;
  const Cell* first;
  CellPlan plan;

  double trials() const { return static_cast<double>(plan.cells) * first->trials; }
};

std::vector<PlannedPart> plan_parts(const Study& study, const fs::path& scratch,
                                    const PilotOptions& pilot) {
  std::vector<PlannedPart> parts;
  for (std::size_t c = 0; c < study.cells.size(); c += parts.back().plan.cells) {
    const auto* design = design_of(study, c);
    if (design != nullptr && design->is_sampled())
      parts.push_back({fmt::format("{} ({})", design->name, name_of(design->kind)), &study.cells[c],
                       plan_design(study, *design, scratch, pilot)});
    else
      parts.push_back({study.cells[c].name, &study.cells[c], plan_cell(study, c, scratch, pilot)});
  }
  return parts;
}

Table plan_table(const Study& study, const std::vector<PlannedPart>& parts,
                 const PlanArguments& arguments) {
  Table table{.title = study.title,
              .columns = {{"cell", ""},
                          {"trials", ""},
                          {"filters", ""},
                          {"samples", ""},
                          {"steps", ""},
                          {"a trial", "ms"},
                          {"time", "s"},
                          {"disk", "MB"},
                          {"pilot trials", ""},
                          {"cells", ""}}};
  double seconds = 0.0, bytes = 0.0, steps = 0.0;
  for (const auto& part : parts) {
    const auto& [cell, plan] = std::tie(*part.first, part.plan);
    const double time = plan.preparation_s + (plan.trials_s + plan.results_s) / arguments.shards;
    seconds += time;
    bytes += plan.bytes();
    steps += plan.steps;
    table.rows.push_back({part.name, static_cast<std::int64_t>(part.trials()),
                          static_cast<std::int64_t>(cell.methods.size()),
                          static_cast<std::int64_t>(cell.scenario.sampling.samples()), plan.steps,
                          1e3 * plan.trials_s / part.trials(), time, 1e-6 * plan.bytes(),
                          std::int64_t{plan.pilot_trials}, static_cast<std::int64_t>(plan.cells)});
    if (plan.measured_cells < plan.cells)
      table.notes.push_back(
          fmt::format("{}: measured at {} of its {} points, the others taken in proportion",
                      part.name, plan.measured_cells, plan.cells));
  }
  table.rows.push_back({"all", static_cast<std::int64_t>(study.trials()), TableCell(), TableCell(),
                        steps, TableCell(), seconds, 1e-6 * bytes, TableCell(),
                        static_cast<std::int64_t>(study.cells.size())});
  const auto shards =
      arguments.shards > 1 ? fmt::format(" for each of {} shards", arguments.shards) : "";
  table.notes.push_back(
      fmt::format("predicted run time {}{}, measured on the first trials of each cell, "
                  "on this machine as busy as it is now",
                  duration(seconds), shards));
  if (std::any_of(study.cells.begin(), study.cells.end(),
                  [](const Cell& c) { return c.stop.has_value(); }))
    table.notes.push_back("that is all trials; a cell with a stop rule may need fewer");
  table.notes.push_back(
      fmt::format("disk {:.3g} GB in all: store and outcomes.csv.gz", 1e-9 * bytes));
  return table;
}

int run(const PlanArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  Study study = read_study(arguments.study);
  if (arguments.trials > 0) set_trials(study, arguments.trials);
  const TemporaryFolder scratch;
  const auto parts = plan_parts(study, scratch.path(), arguments.pilot);
  const auto table = plan_table(study, parts, arguments);
  console.out << render({&table, 1}, format);
  return complete;
}

}  // namespace

void add_plan(CLI::App& program, Console& console, int& exit_code) {
  auto* verb =
      program.add_subcommand("plan", "how long a study will run and how much disk it takes");
  auto arguments = std::make_shared<PlanArguments>();
  verb->add_option("study", arguments->study, "study file (JSON)")->required();
  verb->add_option("--trials", arguments->trials, "trials of every cell, instead of the study's")
      ->check(whole(1, most_trials));
  verb->add_option("--threads", arguments->pilot.threads, "threads of the run (default: all)")
      ->check(whole(1, 1024));
  verb->add_option("--shards", arguments->shards, "parts that the study is run in")
      ->check(whole(1, 1000000))
      ->capture_default_str();
  verb->add_option("--pilot", arguments->pilot.seconds, "seconds for which each cell is tried")
      ->check(within(0.01, 3600.0, "s"))
      ->capture_default_str();
  arguments->format.add_to(verb);
  verb->footer(plan_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
