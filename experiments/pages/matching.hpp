#pragma once

#include <ostream>
#include <string>
#include <vector>

#include <gyrostat/analysis/search/box_search.hpp>
#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat {

/// A published number that a scenario should reproduce.
struct MatchTarget {
  std::string cell, method;
  std::size_t metric = 0;
  double value = 0.0;
  double tolerance = 1.0;  ///< what counts as one unit of deviation
};

/// A parameter that a match may choose: a path within a cell, and its bounds.
struct MatchFree {
  std::string path;
  SearchRange range;
  std::vector<std::string> cells;  ///< where it is set; empty: in every cell
  double start = no_value;  ///< where an earlier search ended: a quarter of the range about it is
                            ///< searched, and the starts of all are tried themselves
};

/// What the search minimises, of deviations in tolerances: the sum of their squares, or the sum of
/// log(1 + d^4), which is near 0 for what is met, gives up what cannot be met, and so comes near
/// the largest number of targets met.
enum class MatchLoss { squares, met };

/// How it searches: `box_search`, or `covariance_search` where many parameters work together.
enum class MatchSearch { box, covariance };

/// The search for the scenario behind published results, by simulated moments: free scenario
/// parameters so that the means over trials of stated metrics come near stated values.
struct Match {
  std::string title;
  Json study;  ///< the study as JSON, with paths free to be set in every cell
  std::string study_path;
  std::vector<MatchFree> free;
  std::vector<MatchTarget> targets;
  MatchSearch search = MatchSearch::box;
  MatchLoss loss = MatchLoss::squares;
  std::uint32_t trials = 20;
  int evaluations = 200;
  int rounds = 2;  ///< each tunes the methods at the scenario found so far, then searches on
};

struct MatchResult {
  std::vector<double> values;   ///< of the free parameters
  std::vector<double> reached;  ///< of the targets, mean over fresh trials
  std::vector<double> half_widths;
  std::vector<double> spreads;  ///< standard deviation over trials: what one experiment may show
  double objective = 0.0;       ///< sum of squared deviations in tolerances
  Json study;                   ///< the study at the values found, tuned values fixed
};

Match read_match(const std::string& path);

/// Runs the search. Trials of the final judgement are fresh. Progress goes to `log`;
/// `threads` as of RunOptions.
MatchResult run_match(const Match& match, std::ostream& log, int threads = 0);

/// What was found, the targets beside what was reached, and one row: how many targets are met, and
/// in which cells and metrics the methods stand in the published order.
std::vector<Table> match_tables(const Match& match, const MatchResult& result);

}  // namespace gyrostat
