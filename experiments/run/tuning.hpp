#pragma once

#include <vector>

#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat {

/// A method over the tuning trials.
struct TuningScore {
  double mean = no_value;       ///< of the plan's metric
  std::size_t broken_down = 0;  ///< trials of them that broke down, which count as well
};

/// What tuning made of one method.
struct TunedMethod {
  ParameterMap values;
  TuningScore before, after;
};

/// Tunes every method of the cell that names parameters to "tune", each by the same procedure: the
/// mean of the plan's metric over trials that the study itself never uses, minimised by box_search
/// with the same number of evaluations. Entries for the other methods are empty.
std::vector<TunedMethod> tune_methods(const Cell& cell, const Calibration& calibration,
                                      std::uint64_t seed);

/// The cell with the tuned values fixed.
Cell with_tuned(const Cell& cell, const std::vector<TunedMethod>& tuned);

}  // namespace gyrostat
