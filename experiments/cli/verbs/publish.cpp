#include <filesystem>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/progress.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/pages/page.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* publish_examples = R"(Examples:
  gyrostat publish PAGE                  runs its studies and writes its tables and text
  gyrostat publish PAGE --text           makes text and figures again, from tables.json
  gyrostat publish PAGE --check          exit 1 where text and tables disagree)";

namespace fs = std::filesystem;

struct PublishArguments {
  std::string folder;
  std::string out;
  std::uint32_t trials = 0;
  int threads = 0;
  bool text = false;
  bool check = false;
};

std::vector<NamedTable> made(const PublishArguments& arguments, const Page& page,
                             Console& console) {
  std::optional<Progress> points;
  std::size_t points_done = 0;
  const auto run = [&](const Study& study, const Cell& cell) {
    Cell shown = cell;
    if (arguments.trials > 0) {
      shown.trials = std::min(arguments.trials, cell.recording ? cell.trials : arguments.trials);
      shown.tuning.trials = 2;
      shown.tuning.evaluations = std::min(shown.tuning.evaluations, 10);
    }
    RunOptions options{.threads = arguments.threads, .progress = {}};
    const auto* design = design_of(study, static_cast<std::size_t>(&cell - study.cells.data()));
    if (design != nullptr && design->is_sampled()) {
      // A bar for all points of a design: each takes a moment.
      const auto total = design->values.size();
      if (!points) points.emplace(console.log, console.log_is_terminal, design->name, total);
      auto result = run_cell(shown, study.seed, options);
      points->set(++points_done);
      if (points_done == total) {
        points.reset();
        points_done = 0;
      }
      return result;
    }
    Progress progress(console.log, console.log_is_terminal, cell.name, shown.trials);
    options.progress = [&](std::size_t done) { progress.set(done); };
    return run_cell(shown, study.seed, options);
  };
  const auto match = [&](Match wanted) {
    if (arguments.trials > 0) {
      wanted.trials = wanted.rounds = 1;
      wanted.evaluations = 5;
      for (auto& cell : wanted.study["cells"]) cell["tuning"] = {{"trials", 2}, {"evaluations", 5}};
    }
    return run_match(wanted, console.log, arguments.threads);
  };
  return page_tables(page, run, match);
}

/// The files that the page consists of, by path.
std::vector<std::pair<fs::path, std::string>> files_of(const Page& page, const fs::path& folder,
                                                       const std::vector<NamedTable>& tables) {
  std::vector<std::pair<fs::path, std::string>> files;
  for (auto& [name, text] : page_files(tables)) files.emplace_back(folder / name, std::move(text));
  for (auto& [name, text] : page_figures(page, tables))
    files.emplace_back(folder / name, std::move(text));
  files.emplace_back((folder / page.output).lexically_normal(), page_text(page, tables));
  return files;
}

int check(const std::vector<std::pair<fs::path, std::string>>& files, Console& console) {
  int exit_code = complete;
  for (const auto& [path, expected] : files) {
    std::ifstream file(path, std::ios::binary);
    const std::string found((std::istreambuf_iterator<char>(file)),
                            std::istreambuf_iterator<char>());
    if (found == expected) continue;
    console.log << path.string() << ": is not what tables.json and page.md make\n";
    exit_code = error;
  }
  return exit_code;
}

int run(const PublishArguments& arguments, Console& console) {
  const Page page = read_page(arguments.folder);
  // A page without sources has its tables from another program.
  const bool from_data = arguments.text || arguments.check || page.sources.empty();
  if ((arguments.text || arguments.check) && arguments.trials > 0)
    throw InputError("--trials", "nothing is run with --text or --check");
  const auto tables =
      from_data ? read_page_tables(arguments.folder) : made(arguments, page, console);
  const fs::path folder = arguments.out.empty() ? arguments.folder : arguments.out;
  const auto files = files_of(page, folder, tables);
  if (arguments.check) return check(files, console);
  make_result_folder(folder);
  for (const auto& [path, text] : files) write_atomically(path, text);
  console.log << fmt::format("{}: {} tables\n", folder.string(), tables.size());
  return complete;
}

}  // namespace

void add_publish(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "publish", "make a page of results: run its studies, write its tables, fill in its text");
  auto arguments = std::make_shared<PublishArguments>();
  verb->add_option("page", arguments->folder, "folder with page.json and page.md")->required();
  verb->add_option("--out", arguments->out, "folder to write to (default: the page's own)");
  verb->add_option("--threads", arguments->threads, "threads (default: all)")
      ->check(whole(1, 1024));
  verb->add_option("--trials", arguments->trials,
                   "trials of every cell; tuning and matching shortened")
      ->check(whole(2, most_trials));
  verb->add_flag("--text", arguments->text,
                 "make text and figures again from tables.json, running nothing");
  verb->add_flag("--check", arguments->check,
                 "write nothing; exit 1 where the page and tables.json disagree");
  verb->footer(publish_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
