#pragma once

#include <cstdint>
#include <vector>

#include <gyrostat/experiments/study/json.hpp>

namespace gyrostat {

struct Cell;

/// What counts as a failure of a trial, "failure" in a study: a metric beyond a threshold, or
/// without a value. How likely it is, is told by plain trials where enough of them fail, else by
/// runs of subset simulation.
struct FailureRule {
  std::size_t metric = 0;            ///< index into metric_types()
  double threshold = 0.0;            ///< in the metric's unit
  bool above = true;                 ///< fails above the threshold, or below
  std::vector<std::size_t> methods;  ///< of the cell
  std::uint32_t runs = 8;            ///< independent ones, for the interval
  std::uint32_t samples = 380;       ///< of each level of a run
  std::uint32_t levels = 10;         ///< of a run, each a tenth as likely as the one before

  /// How bad a value of the metric is: failing above `worst_allowed`.
  double badness(double value) const;
  double worst_allowed() const { return above ? threshold : -threshold; }
};

/// `object` is the "failure" of `cell`, whose methods are known. Throws InputError.
FailureRule read_failure(JsonObject object, const Cell& cell);

}  // namespace gyrostat
