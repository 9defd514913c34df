#include <filesystem>

#include <fmt/format.h>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/report/rank_picture.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* rank_examples = R"(Examples:
  gyrostat rank runs/STUDY                           which filter wins each cell, and how sure that is
  gyrostat rank runs/STUDY --metric heading_worst    by another error
  gyrostat rank runs/STUDY --cell ramp --format latex
  gyrostat rank runs/STUDY --figures F               critical-difference diagrams: F/ranks_1.svg, ...)";

struct RankArguments {
  std::string folder, metric, cell, figures;
  FormatOption format;
};

std::string diagram(const CellRanking& ranking, const MethodColours& colours) {
  auto picture = rank_picture(ranking, colours, "ranks");
  picture.title = fmt::format("{}: mean ranks of {} over {} trials", ranking.cell, ranking.metric,
                              ranking.trials);
  return picture_file(picture);
}

int run(const RankArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const Store store = Store::open(arguments.folder);
  const auto study = stored_study(store);
  const Cell* only =
      arguments.cell.empty() ? nullptr : &cell_named(study, arguments.cell, "--cell");
  if (!arguments.figures.empty()) make_result_folder(arguments.figures);
  const MethodColours colours(study);
  std::vector<Table> tables;
  for (std::uint32_t c = 0; c < study.cells.size(); ++c) {
    const auto& cell = study.cells[c];
    if (only && only != &cell) continue;
    const TrialSource trials = [&](const auto& visit) {
      store.for_each_trial(c, cell.trials, [&](const Store::TrialView& trial) {
        visit(trial.calibrated, trial.outcomes);
      });
    };
    const auto ranking = rank_cell(cell, trials, arguments.metric);
    tables.push_back(ranking_table(ranking));
    if (!arguments.figures.empty())
      write_atomically(fs::path(arguments.figures) / fmt::format("ranks_{}.svg", c + 1),
                       diagram(ranking, colours));
  }
  console.out << render(tables, format);
  return complete;
}

}  // namespace

void add_rank(CLI::App& program, Console& console, int& exit_code) {
  auto* verb =
      program.add_subcommand("rank", "which filter wins each cell of a run, and how sure that is");
  auto arguments = std::make_shared<RankArguments>();
  verb->add_option("folder", arguments->folder, "folder of a run, as runs/<study>")->required();
  verb->add_option("--metric", arguments->metric,
                   "error to rank by (default: the one methods are judged by)");
  verb->add_option("--cell", arguments->cell, "this cell alone");
  verb->add_option("--figures", arguments->figures,
                   "folder for critical-difference diagrams, an SVG a cell");
  arguments->format.add_to(verb);
  verb->footer(rank_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
