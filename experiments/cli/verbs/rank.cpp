#include <filesystem>

#include <fmt/format.h>

#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/cli/answer.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/findings/failure_ranking.hpp>
#include <gyrostat/experiments/findings/ranking_words.hpp>
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
  gyrostat rank runs/STUDY --metric failure          by how likely each fails, where the study asks for that
  gyrostat rank runs/STUDY --cell ramp --format latex
  gyrostat rank runs/STUDY --figures F               critical-difference diagrams: F/ranks_1.svg, ...)";

struct RankArguments {
  std::string folder, metric, cell, figures;
  FormatOption format;
  bool points = false;
};

std::string diagram(const CellRanking& ranking, const MethodColours& colours) {
  auto picture = rank_picture(ranking, colours, "ranks");
  picture.title = fmt::format("{}: mean ranks of {} over {} trials", ranking.cell, ranking.metric,
                              ranking.trials);
  return picture_file(picture);
}

/// Whether a cell is one of more points than anybody reads a ranking of.
bool is_one_of_many(const Study& study, std::size_t cell) {
  constexpr std::size_t few = 20;
  const auto* design = design_of(study, cell);
  return design != nullptr && (design->is_sampled() || design->labels.size() > few);
}

int rank_by_failure(const RankArguments& arguments, const Store& store, const Study& study,
                    const Cell* only, Format format, Console& console) {
  if (!arguments.figures.empty())
    throw InputError("--figures", "diagrams of mean ranks, which --metric failure has not");
  std::vector<Table> tables;
  for (std::uint32_t c = 0; c < study.cells.size(); ++c) {
    const auto& cell = study.cells[c];
    if (cell.failure && (!only || only == &cell))
      tables.push_back(
          failure_ranking_table(cell, failure_findings(study, store, c, arguments.folder)));
  }
  if (tables.empty()) throw InputError(arguments.folder, no_failure_asked_for);
  console.out << render(tables, format);
  return complete;
}

int run(const RankArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const Store store = Store::open(arguments.folder);
  const auto study = stored_study(store);
  const Cell* only =
      arguments.cell.empty() ? nullptr : &cell_named(study, arguments.cell, "--cell");
  if (arguments.metric == "failure")
    return rank_by_failure(arguments, store, study, only, format, console);
  if (!arguments.figures.empty()) make_result_folder(arguments.figures);
  const MethodColours colours(study);
  std::vector<Table> tables;
  std::vector<CellRanking> rankings;
  std::size_t left_out = 0;
  for (std::uint32_t c = 0; c < study.cells.size(); ++c) {
    const auto& cell = study.cells[c];
    if (only && only != &cell) continue;
    const TrialSource trials = [&](const auto& visit) {
      store.for_each_trial(c, cell.trials, [&](const Store::TrialView& trial) {
        visit(trial.calibrated, trial.outcomes);
      });
    };
    rankings.push_back(rank_cell(cell, trials, arguments.metric));
    const auto& ranking = rankings.back();
    if (only || arguments.points || format != Format::text || !is_one_of_many(study, c))
      tables.push_back(ranking_table(ranking));
    else
      ++left_out;
    if (!arguments.figures.empty())
      write_atomically(fs::path(arguments.figures) / fmt::format("ranks_{}.svg", c + 1),
                       diagram(ranking, colours));
  }
  print_answer(console, format, answer_in_words(rankings));
  console.out << render(tables, format);
  if (left_out > 0)
    console.log << fmt::format("--points ranks {} of designs, too\n", counted(left_out, "point"));
  return complete;
}

}  // namespace

void add_rank(CLI::App& program, Console& console, int& exit_code) {
  auto* verb =
      program.add_subcommand("rank", "which filter wins each cell of a run, and how sure that is");
  auto arguments = std::make_shared<RankArguments>();
  verb->add_option("folder", arguments->folder, "folder of a run, as runs/<study>")->required();
  verb->add_option("--metric", arguments->metric,
                   "error to rank by (default: the one methods are judged by), or failure");
  verb->add_option("--cell", arguments->cell, "this cell alone");
  verb->add_flag("--points", arguments->points,
                 "print the ranking at every point of a design, too");
  verb->add_option("--figures", arguments->figures,
                   "folder for critical-difference diagrams, an SVG a cell");
  arguments->format.add_to(verb);
  verb->footer(rank_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
