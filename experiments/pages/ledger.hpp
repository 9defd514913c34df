#pragma once

#include <functional>
#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/run/runner.hpp>

namespace gyrostat {

/// A sentence of a paper as something that trials can decide: in each cell of a study, the mean of
/// a metric of `method` lies below (or above) that of `than`, or below (or above) a value. Instead
/// of a metric, the Allan deviation of the compensated rate at each of some tau.
struct Claim {
  std::string text;
  std::string source;
  std::string of;          ///< the claim that this is one reading of, by a name that readings share
  std::string not_judged;  ///< why nothing here decides it; then all that follows is empty
  std::string study;       ///< index of the study by its path
  std::vector<std::string> cells;  ///< names; empty: every cell
  std::string method;
  std::string than;       ///< empty: compare with `value`, or with `method` in than_cell
  std::string than_cell;  ///< another cell of the study, whose trials are paired by their number
  double value = 0.0;
  std::size_t metric = 0;
  std::vector<double> allan_tau_s;   ///< empty: the metric
  std::uint32_t allan_trials = 100;  ///< the first so many of a cell
  /// theta of the exponential cost [A eq. 7], of the metric's square averaged over time:
  /// exp(theta v^2); 0: the metric itself.
  double exponential_per_dps2 = 0.0;
  bool absolute = false;  ///< of the metric's absolute value
  bool above = false;
};

struct Ledger {
  std::string title;
  std::vector<std::string> studies;  ///< paths
  std::vector<Claim> claims;
};

/// Whether the claim is about this cell of the study at that path.
bool concerns(const Claim& claim, const std::string& study, const Cell& cell);

/// The index of the method called `id`; as many as the cell has where there is none.
std::size_t method_index(const Cell& cell, const std::string& id);

enum class Verdict { holds, does_not_hold, not_separable, equal };  ///< equal: in every trial

/// A claim in one cell: the metric's mean, and the difference to what it is compared with.
struct Finding {
  std::size_t claim = 0;
  std::string cell;  ///< with " at TAU s" of an Allan deviation
  double mean = no_value;
  double mean_half_width = no_value;
  double quantity = no_value;
  double rival_mean = no_value;  ///< of what it is compared with
  double low = no_value, high = no_value;
  double trials_needed = no_value;
  std::size_t trials = 0;
  Verdict verdict = Verdict::not_separable;
};

Ledger read_ledger(const std::string& path);

/// Decides every claim; `run` gives the result of a cell. Intervals are simultaneous (Bonferroni)
/// over all findings of a claim.
std::vector<Finding> judge(const Ledger& ledger,
                           const std::function<CellResult(const Study&, const Cell&)>& run);

/// One row a claim: holds in this scenario, does not hold, or where it holds, and for one that does
/// not hold everywhere the finding most in its favour among all readings of the claim; then one row
/// a finding.
std::vector<Table> ledger_tables(const Ledger& ledger, const std::vector<Finding>& findings);

}  // namespace gyrostat
