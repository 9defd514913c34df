#pragma once

#include <string>
#include <vector>

#include "experiments/cell_summary.hpp"

namespace gyrostat {

/// A method's place in a cell, by the judging metric.
struct RankedMethod {
  std::string method;
  double mean = no_value, half_width = no_value;  ///< of the metric's mean, 95 %
  double mean_rank = no_value;                    ///< over trials, 1 is best, ties share
  double cvar95 = no_value;                       ///< mean of the worst 5 % of trials
  double worst = no_value;
};

/// Which filter wins a cell and how sure that is; the oracle and `none` are ranked beside the others.
struct CellRanking {
  std::string cell, metric, unit;
  std::size_t trials = 0;
  std::vector<RankedMethod> methods;                 ///< by mean, best first
  double critical_difference = no_value;             ///< of mean ranks (Nemenyi)
  std::vector<std::vector<std::size_t>> not_separable;  ///< maximal groups, as indices into `methods`
  std::vector<std::string> sentences;                ///< plain ones, the most important first
};

CellRanking rank_cell(const Cell& cell, const TrialSource& trials);

}  // namespace gyrostat
