#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <gyrostat/analysis/statistics/paired.hpp>
#include <gyrostat/analysis/statistics/trial_measure.hpp>
#include <gyrostat/experiments/run/runner.hpp>

namespace gyrostat {

/// By what a method is tuned, and how much that may cost.
struct TuningGoal {
  std::size_t metric = 0;  ///< error_metric_named
  TrialMeasure measure{};
  std::size_t budget = 8000;  ///< runs of the method over one trial, for the search
  std::uint32_t fresh = 400;  ///< trials that no search has seen and that judge
  std::map<std::string, SearchRange> ranges{};  ///< instead of those below, by parameter
};

/// One parameter of a tuned method.
struct TunedParameter {
  std::string name, unit;
  SearchRange range;
  double before = no_value, value = no_value;  ///< `before` is that of the cell's calibration
  /// Beyond these, with the other parameters held, fresh trials tell the method from the tuned one
  /// as worse (a confidence set by inverting the paired test, 95 %). The ends of the range where
  /// they do nowhere.
  double low = no_value, high = no_value;
  PairedDifference at_low, at_high;  ///< what the measure grows by at the ends of the range
  bool matters = false;  ///< at one of the ends fresh trials tell a growth of more than 1 %
};

/// The best of a stage of the search on the fresh trials.
struct TuningStage {
  std::string what;
  std::size_t candidates = 0, trials = 0, runs = 0;  ///< as SearchStage has them
  TrialMeasure::Value fresh;
};

/// What `tune_method` found.
struct MethodTuning {
  std::string method;
  std::vector<TunedParameter> parameters;
  TrialMeasure::Value before, after;  ///< on the fresh trials: what is claimed is `after`
  PairedDifference gain;              ///< before - after, on the fresh trials
  double on_search = no_value;        ///< the measure on the trials of the search: too good
  std::vector<TuningStage> curve;
  std::size_t runs = 0;  ///< of the method over one trial, the fresh ones included

  /// Whether fresh trials tell that the tuned values are better.
  bool is_better() const { return gain.separable && gain.mean > 0.0; }
};

/// What a method is tuned over: its "tune" where it has one. Otherwise every parameter but
/// switches, initial deviations and the drift's coefficients, which a calibration measures: a
/// decade about the value of the calibration for a positive one, within its own range; the whole
/// of that where it is finite and holds both signs, else thrice the value to either side. A
/// parameter that is 0 and has no such range is not tuned.
std::map<std::string, SearchRange> tuning_ranges(const PreparedCell& prepared,
                                                 const Method& method);

/// Called with what is being done and the share of all that is done.
using TuningProgress = std::function<void(const std::string& what, double share)>;

/// The best parameters of method `method` of a cell, by `staged_search` over trials of the cell
/// that no study ever runs, judged by further trials that the search has not seen either; values
/// are rounded to four digits before they are judged. The cell's calibration stays what it is.
/// Throws Interrupted once `options.stop` is set, and InputError where there is nothing to tune.
///
/// Example: a strong tracking filter for the worst trials.
///
///   #include <gyrostat/analysis/error_metric.hpp>
///
///   const Study study = read_study("study.json");
///   const auto tuned = tune_method(study.cells[0], 1, study.seed,
///                                  {.metric = error_metric_named("bias_rmse", "example"),
///                                   .measure = {.kind = TrialMeasure::Kind::cvar95}},
///                                  {});
///   for (const auto& p : tuned.parameters) std::printf("%s %g\n", p.name.c_str(), p.value);
///
/// Thread safety: as run_cell.
MethodTuning tune_method(const Cell& cell, std::size_t method, std::uint64_t seed,
                         const TuningGoal& goal, const RunOptions& options,
                         const TuningProgress& progress = {});

/// The measure of the method with `values` on trials from `first` on of those that judge: what a
/// promise can be held against.
TrialMeasure::Value measure_tuned(const Cell& cell, std::size_t method, std::uint64_t seed,
                                  const TuningGoal& goal, const ParameterMap& values,
                                  std::uint32_t first, std::uint32_t last,
                                  const RunOptions& options);

}  // namespace gyrostat
