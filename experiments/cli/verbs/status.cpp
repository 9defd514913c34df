#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/statistics/sequential.hpp>
#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/cli/answer.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/failures.hpp>
#include <gyrostat/experiments/run/stopping.hpp>
#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/experiments/study/address.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/results/store.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* status_examples = R"(Examples:
  gyrostat status runs/STUDY               how far it is, while it runs or afterwards
  watch gyrostat status runs/STUDY
  gyrostat status runs/STUDY --failures    addresses of all trials that failed, for gyrostat replay)";

struct StatusArguments {
  std::string folder;
  bool failures = false;
  FormatOption format;
};

/// The cells from `first` on that are points of one design, by their names; one where there are
/// few.
std::uint32_t together(const Manifest& manifest, std::uint32_t first) {
  constexpr std::uint32_t few = 20;
  const auto design =
      manifest.cells[first].name.substr(0, manifest.cells[first].name.find('[') + 1);
  std::uint32_t last = first;
  while (design.ends_with('[') && last < manifest.cells.size() &&
         manifest.cells[last].name.starts_with(design))
    ++last;
  return last - first > few ? last - first : 1;
}

Table cells_table(const Store& store, const Manifest& manifest) {
  Table table{
      .title = fmt::format("{}: seed {}, digest {}", manifest.name, manifest.seed, manifest.digest),
      .columns = {{"cell", ""}, {"finished", ""}, {"trials", ""}, {"failed", ""}}};
  for (std::uint32_t c = 0; c < manifest.cells.size();) {
    const std::uint32_t count = together(manifest, c);
    const auto name =
        count == 1 ? manifest.cells[c].name
                   : fmt::format("{} ({} points)",
                                 manifest.cells[c].name.substr(0, manifest.cells[c].name.find('[')),
                                 count);
    std::int64_t finished = 0, trials = 0, failed = 0;
    for (const auto end = c + count; c < end; ++c) {
      const auto& cell = manifest.cells[c];
      finished += std::min(cell.finished, cell.trials);
      trials += cell.trials;
      failed += store.failed_trials(c, cell.trials);
    }
    table.rows.push_back({name, finished, trials, failed});
  }
  return table;
}

/// Why cells have stopped before all of their trials, where rules have been asked.
Table stops_table(const Store& store) {
  Table table{.title = "stop rules", .columns = {{"cell", ""}, {"trials", ""}, {"stopped", ""}}};
  const auto study = stored_study(store);
  for (std::uint32_t c = 0; c < study.cells.size(); ++c) {
    const auto& cell = study.cells[c];
    if (!cell.stop) continue;
    const auto looks = look_counts(cell.stop->at_least, cell.trials);
    std::uint32_t finished = 0;
    const auto reason = stop_reason(cell, cell.trials, [&](const auto& visit) {
      finished = 0;
      store.for_each_trial(c, cell.trials, [&](const Store::TrialView& trial) {
        ++finished;
        visit(trial.outcomes);
      });
    });
    const bool at_look = !looks.empty() && looks.back() == cell.trials && finished == cell.trials;
    table.rows.push_back(
        {cell.name, std::int64_t{finished}, at_look && reason ? *reason : "not yet"});
  }
  return table;
}

/// How far the searches for failures are, where there are any.
Table searches_table(const Store& store, const std::filesystem::path& folder) {
  Table table{
      .title = "searches for failures",
      .columns = {
          {"cell", ""}, {"method", ""}, {"trials", ""}, {"levels", ""}, {"runs ended", ""}}};
  const auto study = stored_study(store);
  for (std::uint32_t c = 0; c < study.cells.size(); ++c) {
    if (!study.cells[c].failure) continue;
    for (const auto& f : failure_findings(study, store, c, folder)) {
      if (!f.search) continue;
      std::size_t levels = 0, ended = 0;
      for (const auto& run : f.search->runs()) {
        levels = std::max(levels, run.levels().size());
        ended += run.asked().empty();
      }
      table.rows.push_back({study.cells[c].name, f.method, std::int64_t{f.search->trials()},
                            static_cast<std::int64_t>(levels),
                            out_of(ended, f.search->runs().size())});
    }
  }
  return table;
}

/// "ramp: 10/40, 3 trials/s, 10 s left, widest ± 0.01 (kf)", of what a session noted last.
std::string last_words(const Session& session) {
  const auto p = Json::parse(session.progress, nullptr, false);
  if (!p.is_object() || !p.contains("cell")) return "–";
  auto text = fmt::format("{}: {}/{}, {:.1f} trials/s, {:.0f} s left", p.value("cell", ""),
                          p.value("finished", 0), p.value("trials", 0),
                          p.value("trials_per_s", 0.0), p.value("left_s", 0.0));
  if (p.contains("widest"))
    text += fmt::format(", widest ± {:.2g} ({})", p["widest"].value("half_width", 0.0),
                        p["widest"].value("method", ""));
  return text;
}

Table sessions_table(const Store& store) {
  Table table{.title = "sessions",
              .columns = {{"started", "UTC"},
                          {"process", ""},
                          {"trials", ""},
                          {"last batch", ""},
                          {"build", ""},
                          {"compiler", ""},
                          {"flags", ""},
                          {"machine", ""}}};
  for (const auto& session : store.sessions())
    table.rows.push_back({session.started, session.process, session.trials, last_words(session),
                          session.build.version, session.build.compiler, session.build.flags,
                          session.machine});
  return table;
}

Table failures_table(const Store& store, const Manifest& manifest) {
  Table table{.title = "failures", .columns = {{"address", ""}, {"reason", ""}}};
  store.for_each_failure([&](const Failure& failure) {
    const auto& cell = manifest.cells.at(failure.cell);
    table.rows.push_back(
        {address_text(manifest.name, cell.name, failure.trial, cell.methods.at(failure.method)),
         failure.reason});
  });
  return table;
}

/// How far it is and what to do next.
std::string status_answer(const Store& store, const Manifest& manifest) {
  std::int64_t finished = 0, trials = 0, failed = 0;
  for (std::uint32_t c = 0; c < manifest.cells.size(); ++c) {
    const auto& cell = manifest.cells[c];
    finished += std::min(cell.finished, cell.trials);
    trials += cell.trials;
    failed += store.failed_trials(c, cell.trials);
  }
  const auto how_many = failed == 0 ? std::string("none") : std::to_string(failed);
  if (finished == trials)
    return fmt::format("{} is complete: {}, {} failed.", manifest.name,
                       counted(static_cast<std::uint64_t>(trials), "trial"), how_many);
  return fmt::format(
      "{} has {} of {} ({:.0f} %), {} failed. gyrostat run of the same study goes on.",
      manifest.name, finished, counted(static_cast<std::uint64_t>(trials), "trial"),
      std::floor(100.0 * static_cast<double>(finished) / static_cast<double>(trials)), how_many);
}

int run(const StatusArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const Store store = Store::open(arguments.folder);
  const auto manifest = store.manifest();
  std::vector<Table> tables;
  if (arguments.failures)
    tables = {failures_table(store, manifest)};
  else
    tables = {cells_table(store, manifest), sessions_table(store)};
  if (!arguments.failures && manifest.source.find("\"stop\"") != std::string::npos)
    tables.insert(tables.begin() + 1, stops_table(store));
  if (!arguments.failures && manifest.source.find("\"failure\"") != std::string::npos)
    if (auto searches = searches_table(store, arguments.folder); !searches.rows.empty())
      tables.push_back(std::move(searches));
  if (!arguments.failures) print_answer(console, format, status_answer(store, manifest));
  console.out << render(tables, format);
  return complete;
}

}  // namespace

void add_status(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand("status", "how far a run is, who made it, and what failed");
  auto arguments = std::make_shared<StatusArguments>();
  verb->add_option("folder", arguments->folder, "folder of a run, as runs/<study>")->required();
  verb->add_flag("--failures", arguments->failures, "the trials that failed, with their addresses");
  arguments->format.add_to(verb);
  verb->footer(status_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
