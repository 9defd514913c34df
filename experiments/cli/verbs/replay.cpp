#include <bit>
#include <filesystem>

#include <fmt/format.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/failures.hpp>
#include <gyrostat/experiments/run/runner.hpp>
#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/experiments/run/trials_together.hpp>
#include <gyrostat/experiments/study/address.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* replay_examples = R"(Examples:
  gyrostat status runs/STUDY --failures                    the addresses of what failed
  gyrostat replay STUDY:ramp:17:sr_ukf                     its outcome, from the study in runs/STUDY
  gyrostat replay runs/OTHER:ramp:17:sr_ukf                the folder of the run in the study's place
  gyrostat replay STUDY:ramp:17:sr_ukf --steps > steps.csv every step of it
  gyrostat replay STUDY:ramp:17:sr_ukf --study STUDY.json  without a run
  gyrostat replay STUDY:ramp:failure:kf --steps            the most likely failing signal, see gyrostat failure)";

struct ReplayArguments {
  std::string address, study, store;
  FormatOption format;
  bool steps = false;
};

/// An address may begin with the folder of a run, as `status` and the others take it.
fs::path store_of(const ReplayArguments& arguments) {
  if (!arguments.store.empty()) return arguments.store;
  const fs::path study = study_of_address(arguments.address);
  return fs::exists(study / Store::file_name) || study.has_parent_path() ? study : "runs" / study;
}

Study study_of(const ReplayArguments& arguments) {
  if (!arguments.study.empty()) return read_study(arguments.study);
  const auto folder = store_of(arguments);
  if (!fs::exists(folder / Store::file_name))
    throw InputError(folder.string(),
                     "there is no run here; name its folder with --store, or the study "
                     "file with --study");
  return stored_study(Store::open(folder));
}

/// A store may have more trials than were asked for last, or than the study file says.
void admit_stored_trials(Study& study, const fs::path& folder) {
  if (!fs::exists(folder / Store::file_name)) return;
  const auto cells = Store::open(folder).manifest().cells;
  for (std::size_t c = 0; c < std::min(cells.size(), study.cells.size()); ++c)
    study.cells[c].trials = std::max({study.cells[c].trials, cells[c].trials, cells[c].finished});
}

std::string number(double value) { return std::isnan(value) ? "" : fmt::format("{:.17g}", value); }

void print_steps(const Series& series, const Track& track, std::ostream& out) {
  out << "t_s,gyro_dps,estimate_dps,estimate_variance,innovation_dps,innovation_variance,status\n";
  for (std::size_t i = 0; i < track.status.size(); ++i)
    out << fmt::format("{},{},{},{},{},{},{}\n", number(series.t_s[i]), number(series.gyro_dps[i]),
                       number(track.estimate_dps[i]), number(track.estimate_variance[i]),
                       number(track.innovation_dps[i]), number(track.innovation_variance[i]),
                       name_of(track.status[i]));
}

Table outcome_table(const std::string& address, const Outcome& outcome, const std::string& thrown) {
  Table table{.title = address, .columns = {{"metric", ""}, {"value", ""}}};
  for (std::size_t m = 0; m < metric_types().size(); ++m)
    table.rows.push_back({metric_types()[m].id, gyrostat::cell(outcome.metric(m))});
  for (std::size_t s = 0; s < status_names.size(); ++s)
    table.rows.push_back({"steps: " + std::string(status_names[s]),
                          static_cast<std::int64_t>(outcome.steps(static_cast<Status>(s)))});
  table.rows.push_back({"diverged", outcome.diverged() ? "yes" : "no"});
  if (!thrown.empty()) table.notes.push_back("threw: " + thrown);
  return table;
}

/// Whether the store has this very outcome; nothing to say where it has none.
std::string compared(const Store& store, const TrialAddress& at,
                     const std::vector<double>& replayed) {
  std::string verdict;
  store.for_each_trial(static_cast<std::uint32_t>(at.cell), at.trial + 1, [&](const auto& trial) {
    if (trial.trial != at.trial) return;
    const bool same =
        std::equal(trial.outcomes.begin(), trial.outcomes.end(), replayed.begin(), replayed.end(),
                   [](double a, double b) {
                     return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
                   });
    verdict = same ? "the same outcome, to the bit, as in the store"
                   : "the store has another outcome: was it made by another build?";
  });
  return verdict;
}

/// "STUDY:ramp:failure:kf", the most likely failing signal, is a trial by another name.
std::optional<std::string> as_a_trial(const std::string& address) {
  constexpr std::string_view name = ":failure:";
  const auto at = address.rfind(name);
  if (at == std::string::npos || address.find(':', at + name.size()) != std::string::npos)
    return std::nullopt;
  return std::string(address).replace(at, name.size(), ":0:");
}

int replay_failure(const ReplayArguments& arguments, const std::string& as_trial,
                   Console& console) {
  const auto format = arguments.format.get();
  const auto folder = store_of(arguments);
  if (!fs::exists(folder / Store::file_name))
    throw InputError(folder.string(), "there is no run here; name its folder with --store");
  const Study study = stored_study(Store::open(folder));
  const auto at = parse_address(as_trial, study);
  auto prepared = prepare_cell(study.cells[at.cell], study.seed, 0);
  const auto signal =
      found_signal(study, static_cast<std::uint32_t>(at.cell), at.method, prepared, folder);
  if (!signal)
    throw InputError(arguments.address, "no failing signal is known: gyrostat failure " +
                                            folder.string() + " tells how far the search is");
  prepared.cell.methods = {prepared.cell.methods[at.method]};
  std::vector<Workspace> workspaces(1);
  const auto record = run_trial(prepared.cell, prepared.calibration,
                                Noise{failure_seed(study), 0, signal->shares}, workspaces);
  if (!record.thrown[0].empty())
    throw std::runtime_error(arguments.address + ": " + record.thrown[0]);
  if (arguments.steps) {
    track_trial(prepared.cell, prepared.cell.methods[0], prepared.calibration,
                Noise{failure_seed(study), 0, signal->shares}, workspaces[0]);
    print_steps(workspaces[0].series, workspaces[0].track, console.out);
    return complete;
  }
  auto table = outcome_table(arguments.address, record.of(0), "");
  table.notes.push_back(
      "the most likely failing signal: deviates that failing trials have in common");
  console.out << render({&table, 1}, format);
  return complete;
}

int run(const ReplayArguments& arguments, Console& console) {
  if (const auto trial = as_a_trial(arguments.address))
    return replay_failure(arguments, *trial, console);
  const auto format = arguments.format.get();
  Study study = study_of(arguments);
  admit_stored_trials(study, store_of(arguments));
  const auto at = parse_address(arguments.address, study);
  const auto prepared = prepare_cell(study.cells[at.cell], study.seed, 0);
  const auto& cell = prepared.cell;
  std::vector<Workspace> workspaces(1);
  const auto record = run_trial(cell, prepared.calibration, study.seed, at.trial, workspaces);
  const auto& thrown = record.thrown[at.method];
  if (arguments.steps) {
    if (!thrown.empty()) throw std::runtime_error(arguments.address + ": " + thrown);
    track_trial(cell, cell.methods[at.method], prepared.calibration, {study.seed, at.trial},
                workspaces[0]);
    print_steps(workspaces[0].series, workspaces[0].track, console.out);
    return complete;
  }
  auto table = outcome_table(arguments.address, record.of(at.method), thrown);
  if (const auto folder = store_of(arguments); fs::exists(folder / Store::file_name)) {
    const auto row = row_of(static_cast<std::uint32_t>(at.cell), at.trial, record);
    for (const auto& failure : row.failures)
      if (failure.method == at.method) table.notes.push_back("in quarantine: " + failure.reason);
    const auto verdict = compared(Store::open(folder), at, row.outcomes);
    if (!verdict.empty()) table.notes.push_back(verdict);
  }
  console.out << render({&table, 1}, format);
  return complete;
}

}  // namespace

void add_replay(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand("replay", "run one filter in one trial of a study again");
  auto arguments = std::make_shared<ReplayArguments>();
  verb->add_option("address", arguments->address,
                   "study:cell:trial:filter, or failure as the trial")
      ->required();
  verb->add_option("--study", arguments->study,
                   "study file (default: the study that the run keeps)");
  verb->add_option("--store", arguments->store, "folder of the run (default: runs/<study>)");
  verb->add_flag("--steps", arguments->steps, "print every step as CSV");
  arguments->format.add_to(verb);
  verb->footer(replay_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
