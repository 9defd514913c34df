#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/findings/cell_summary.hpp>

namespace gyrostat {

struct CellResult;

/// A method's place in a cell, by the judging metric.
struct RankedMethod {
  std::string method;
  double mean = no_value, half_width = no_value;  ///< of the metric's mean, 95 %
  double mean_rank = no_value;                    ///< over trials, 1 is best, ties share
  double cvar95 = no_value;                       ///< mean of the worst 5 % of trials
  double worst = no_value;
  double cvar95_low = no_value, cvar95_high = no_value;  ///< 95 % interval; none below 200 trials
  std::size_t diverged = 0, broken_down = 0;             ///< trials, which stay in the mean
  std::size_t missing = 0;                               ///< trials without a value; they rank last
};

/// Two methods of a ranking; the difference is that of `worse` minus `better`.
struct RankedPair {
  std::size_t better = 0, worse = 0;  ///< indices into `methods`, by their means
  PairedDifference difference;        ///< simultaneous over all pairs
};

/// Which filter wins a cell and how sure that is; the oracle and `none` are ranked beside the
/// others. A metric with a sign is ranked by its size, and small is good.
struct CellRanking {
  std::string cell, metric, unit;
  std::size_t trials = 0;
  std::vector<RankedMethod> methods;      ///< by mean, best first
  double critical_difference = no_value;  ///< of mean ranks (Nemenyi)
  static constexpr std::size_t most_groups = 64;
  /// Maximal groups, as indices into `methods`; where there are `most_groups`, maybe not all.
  std::vector<std::vector<std::size_t>> not_separable;
  std::vector<std::string> sentences;  ///< plain ones, the most important first
  std::vector<RankedPair> pairs;
  double friedman_p = no_value;   ///< of mean ranks so different where all methods are alike
  std::string winner{};           ///< best mean of those that are no bound and no floor
  bool winner_is_shared = false;  ///< not separable from another of those
  double share_worse =
      no_value;  ///< with 95 % confidence, fewer trials than this are worse than `worst`
};

/// The metric is the judging metric where `metric` is empty. A few passes over the trials, in
/// memory that does not grow with them. Throws InputError for a metric of which small is not good.
///
/// Example: who wins a cell of a stored run.
///
///   const Study study = read_study("study.json");
///   const Store store = Store::open("runs/study");
///   const TrialSource trials = [&](const auto& visit) {
///     store.for_each_trial(0, study.cells[0].trials, [&](const Store::TrialView& trial) {
///       visit(trial.calibrated, trial.outcomes);
///     });
///   };
///   const CellRanking ranking = rank_cell(study.cells[0], trials);
///   for (const auto& sentence : ranking.sentences) std::puts(sentence.c_str());
///
/// Thread safety: may run in any number of threads at once, each with a source of its own.
CellRanking rank_cell(const Cell& cell, const TrialSource& trials, const std::string& metric = "");

/// The same of trials that were run in memory.
///
/// Example: a cell run and ranked, without a store.
///
///   const Cell cell = read_study("study.json").cells[0];
///   const CellResult result = run_cell(cell, 1, {});
///   const Table table = ranking_table(rank_cell(cell, result));
///   std::fputs(render({&table, 1}, Format::text).c_str(), stdout);
CellRanking rank_cell(const Cell& cell, const CellResult& result, const std::string& metric = "");

/// One row a method, best first, with the sentences as notes.
Table ranking_table(const CellRanking& ranking);

}  // namespace gyrostat
