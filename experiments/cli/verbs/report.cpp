#include <optional>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/report/report.hpp>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/phase_progress.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* report_examples = R"(Examples:
  gyrostat report runs/STUDY                    to runs/STUDY/report.html, to be opened in a browser
  gyrostat report runs/STUDY --cell ramp        that cell in full, whatever else the study has
  gyrostat report runs/STUDY --replay 0         without simulating any trial again)";

struct ReportArguments {
  std::string folder, out;
  ReportOptions options;
};

int run(const ReportArguments& arguments, Console& console) {
  const auto database = fs::path(arguments.folder) / Store::file_name;
  if (!fs::exists(database))
    throw InputError(arguments.folder,
                     "there is no run here; a folder that gyrostat run made is needed");
  const auto out =
      arguments.out.empty() ? fs::path(arguments.folder) / "report.html" : fs::path(arguments.out);
  require_writable(out, database);
  const Store store = Store::open(arguments.folder);
  auto options = arguments.options;
  std::optional<PhaseProgress> progress;
  progress.emplace(console.log, console.log_is_terminal, "report");
  options.progress = [&](const std::string& phase, const std::string& detail, double share) {
    progress->set(phase, detail, share);
  };
  const auto page = report_page(stored_study(store), store, arguments.folder, options);
  progress.reset();
  write_atomically(out, page);
  console.log << fmt::format("report: {}\n", out.string());
  return complete;
}

}  // namespace

void add_report(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand("report", "a run's results as one page to open in a browser");
  auto arguments = std::make_shared<ReportArguments>();
  verb->add_option("folder", arguments->folder, "folder of a run, as runs/<study>")->required();
  verb->add_option("--out", arguments->out,
                   "HTML file to write (default: report.html in the folder)");
  verb->add_option("--cell", arguments->options.cells, "a cell to show in full; may be repeated");
  verb->add_option("--replay", arguments->options.replay,
                   "trials simulated again for pictures over time (default: 2 to 64 by the length "
                   "of a trial)")
      ->check(whole(0, 100000));
  verb->add_option("--threads", arguments->options.threads, "threads (default: all)")
      ->check(whole(1, 1024));
  verb->footer(report_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
