#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <gyrostat/analysis/statistics/paired.hpp>
#include <gyrostat/analysis/statistics/running.hpp>
#include <gyrostat/analysis/statistics/summary.hpp>
#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat {

/// What the tables say of one method of a cell.
struct MethodSummary {
  std::vector<Summary> metrics;  ///< by metric; only those that tables show have values
  std::size_t diverged = 0, broken_down = 0, breakdown_steps = 0, thrown = 0;
  std::vector<Running> running;  ///< by metric; only those that tell of consistency have values
  PairedDifference difference;   ///< in the judging metric, from the best method
};

struct CellSummary {
  std::size_t finished = 0;
  std::size_t unconverged = 0;  ///< trials whose own calibration did not converge
  std::size_t best = 0;         ///< of all but the oracle, the smallest mean of the judging metric
  double looks = 1.0;           ///< by which a stop rule's looking widens intervals of differences
  std::vector<MethodSummary> methods;

  const Summary& of(std::size_t method, std::string_view metric) const;
  const Running& running(std::size_t method, std::string_view metric) const;
};

/// Metrics that have a table of errors, in the tables' order.
std::vector<std::string_view> error_metrics(const Cell& cell);

/// Hands every finished trial of a cell to `visit`, in order, each time it is called: whether its
/// calibration converged, and its outcomes as the store has them.
using TrialSource = std::function<void(
    const std::function<void(bool calibrated, std::span<const double> outcomes)>& visit)>;

/// Three passes over the trials, or a few more for millions of them; memory does not grow with
/// their number. The statistics are those of `summarise`, to the bit, and of `AllPairs`.
CellSummary summarise_cell(const Cell& cell, const TrialSource& trials);

}  // namespace gyrostat
