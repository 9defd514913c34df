#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gyrostat/experiments/findings/tuning_tables.hpp>

namespace gyrostat {

/// What is to be tuned of a study, and by what, as it was asked for.
struct TuningRequest {
  std::string metric = "bias_rmse", by = "mean";  ///< "mean" or "cvar95"
  std::optional<double> above{};       ///< by the probability of an error above this, in its unit
  std::string cell{};                  ///< this one alone; empty: every cell
  std::vector<std::string> methods{};  ///< these alone; none: those with a "tune", or every filter
  std::vector<std::string> ranges{};   ///< "phi=0.1:0.9", instead of the study's or default ones
  TuningGoal goal{};                   ///< with its budget and fresh trials; the rest follows
  std::string option_prefix = "--";    ///< what stands before an option's name in messages
};

/// What came out, with the goal that the request comes to.
struct StudyTuning {
  TuningGoal goal;
  std::vector<CellTuning> cells;
};

/// Tunes the methods of a study that the request asks for. Throws InputError that names the option,
/// and Interrupted once `options.stop` is set.
///
/// Example: every filter of a study, for the worst 5 % of its trials.
///
///   const Study study = read_study("study.json");
///   const auto found = tune_study(study, {.by = "cvar95"}, {});
///   std::puts(tuning_in_words(found.cells, found.goal).c_str());
///
/// Thread safety: as run_cell.
StudyTuning tune_study(const Study& study, const TuningRequest& request, const RunOptions& options,
                       const TuningProgress& progress = {});

}  // namespace gyrostat
