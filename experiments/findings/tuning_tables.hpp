#pragma once

#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/run/method_tuning.hpp>
#include <gyrostat/experiments/study/json.hpp>

namespace gyrostat {

/// What was tuned in one cell.
struct CellTuning {
  std::size_t cell = 0;  ///< of the study
  std::string name;
  std::vector<MethodTuning> methods;
};

/// In two sentences: what tuning gains, and which method is then best or what does not matter.
std::string tuning_in_words(const std::vector<CellTuning>& all, const TuningGoal& goal);

/// For each cell: what each method gains; for each method its parameters with their intervals, how
/// much each matters, and the best value over the runs of the search.
std::vector<Table> tuning_tables(const std::vector<CellTuning>& all, const TuningGoal& goal);

/// All of it for programs.
Json tuning_json(const std::vector<CellTuning>& all, const TuningGoal& goal);

/// The study's JSON with the tuned values where fresh trials tell that they are better; the other
/// methods stay as they are. What a tuned method had to "tune" is taken out. Recordings and
/// fleets are named as seen from the folder of `out`.
Json with_tuned_values(const Study& study, const std::vector<CellTuning>& all,
                       const std::string& out);

}  // namespace gyrostat
