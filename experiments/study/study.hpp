#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/analysis/calibration.hpp>
#include <gyrostat/experiments/study/design.hpp>
#include <gyrostat/experiments/study/failure_rule.hpp>
#include <gyrostat/experiments/study/json.hpp>
#include <gyrostat/experiments/study/method.hpp>
#include <gyrostat/experiments/study/stop_rule.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat {

class Fleet;

/// How the filters of a cell come by their parameters: from a calibration signal of the same
/// scenario that no trial sees, one for the whole cell or one for each trial.
struct CalibrationPlan {
  FitMethod method = FitMethod::likelihood;
  bool each_trial = false;
  double duration_s = 0.0;  ///< 0: as long as the scenario
};

/// How methods that name parameters to "tune" are tuned, all alike.
struct TuningPlan {
  std::size_t metric = 0;  ///< index into metric_types(), the mean of which is made small
  std::uint32_t trials = 20;
  int evaluations = 60;
  bool undisturbed = false;  ///< on signals without the scenario's magnetic disturbances
};

/// One scenario, or one recording in pieces, with the filters that are tried on it.
struct Cell {
  std::string name;
  std::uint32_t trials = 1000;
  Scenario scenario;                        ///< of a fleet the nominal one, see sensor_of
  std::shared_ptr<const Fleet> fleet;       ///< where present, each trial draws its sensor from it
  std::shared_ptr<const Series> recording;  ///< where present, trials are successive pieces of it,
  Series calibration_span;                  ///< and this, which comes before, is calibrated on
  CalibrationPlan calibration;
  TuningPlan tuning;
  ParameterMap assumed;  ///< factors on what filters other than the oracle are told
  bool denoise =
      false;  ///< the rate is denoised by wavelet shrinkage before its error is judged [B]
  std::vector<Method> methods;
  std::optional<StopRule> stop;        ///< before all trials are run
  std::optional<FailureRule> failure;  ///< whose probability is asked for

  /// Whether any method starts from fitted parameters.
  bool needs_calibration() const;
};

struct Study {
  std::string title;
  std::uint64_t seed = 1;
  std::vector<Cell> cells;
  std::vector<Design> designs;  ///< of whose points cells were made
  double failure_budget = 1.0;  ///< share of all trials that may throw or break down
  std::string path;             ///< of the study file
  std::string source;           ///< its JSON
  std::string digest;           ///< of all in it that decides an outcome, see study_digest

  /// What the study is called in folders and addresses: its file without the extension.
  std::string name() const;
  std::uint64_t trials() const;  ///< of all cells
};

/// The metric that methods of a cell are compared by: the bias error where the truth is known.
std::string_view judging_metric(const Cell& cell);

/// The design that a cell is a point of; nullptr for a cell of its own.
const Design* design_of(const Study& study, std::size_t cell);

/// Sets the number of trials of every cell; a recording has no more than its pieces.
void set_trials(Study& study, std::uint32_t trials);

/// The cell called `name`, the first where that is empty; throws InputError at `place` otherwise.
const Cell& cell_named(const Study& study, const std::string& name, const std::string& place);

/// Reads and checks a study file; recordings it names are relative to its own folder. Throws one
/// InputError with a line for each mistake: JSON path, value, unit, allowed range, nearest known
/// name.
///
/// Example: a study from its file, or all that is wrong with it.
///
///   try {
///     Study study = read_study("study.json");
///     set_trials(study, 100);
///   } catch (const InputError& mistakes) {
///     std::puts(mistakes.what());
///   }
///
/// Thread safety: may run in any number of threads at once. A study is a value that others only
/// read.
Study read_study(const std::string& path);

/// The same for a study's JSON; `path` is what messages name and where recordings are looked for,
/// `mistakes` are those already known.
///
/// Example: a study that the program writes itself.
///
///   #include <nlohmann/json.hpp>
///
///   const auto study = parse_study(Json::parse(R"({
///     "cells": [{"name": "short", "trials": 20,
///                "scenario": {"duration_s": 10, "rate_hz": 100}, "filters": ["none", "kf"]}]
///   })"), "example.json");
Study parse_study(const Json& json, const std::string& path, Mistakes mistakes);
Study parse_study(const Json& json, const std::string& path);

}  // namespace gyrostat
