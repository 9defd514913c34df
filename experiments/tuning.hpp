#pragma once

#include <vector>

#include "experiments/study.hpp"

namespace gyrostat {

/// What tuning made of one method.
struct TunedMethod {
  ParameterMap values;
  double objective_before = no_value;  ///< mean of the metric over the tuning trials
  double objective_after = no_value;
};

/// Tunes every method of the cell that names parameters to "tune", each by the same procedure: the
/// mean of the plan's metric over trials that the study itself never uses, minimised by box_search
/// with the same number of evaluations. Entries for the other methods are empty.
std::vector<TunedMethod> tune_methods(const Cell& cell, const Calibration& calibration,
                                      std::uint64_t seed);

/// The cell with the tuned values fixed.
Cell with_tuned(const Cell& cell, const std::vector<TunedMethod>& tuned);

}  // namespace gyrostat
