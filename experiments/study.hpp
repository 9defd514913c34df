#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/calibration.hpp"
#include "experiments/method.hpp"
#include "generators/scenario.hpp"

namespace gyrostat {

/// How the filters of a cell come by their parameters: from a calibration signal of the same
/// scenario that no trial sees, one for the whole cell or one for each trial.
struct CalibrationPlan {
  FitMethod method = FitMethod::likelihood;
  bool each_trial = false;
  double duration_s = 0.0;  ///< 0: as long as the scenario
};

/// One scenario with the filters that are tried on it.
struct Cell {
  std::string name;
  std::uint32_t trials = 1000;
  Scenario scenario;
  CalibrationPlan calibration;
  ParameterMap assumed;  ///< factors on what filters other than the oracle are told
  std::vector<Method> methods;
};

struct Study {
  std::string title;
  std::uint64_t seed = 1;
  std::vector<Cell> cells;
};

/// Reads and checks a study file; recordings it names are relative to its own folder. Throws
/// InputError with the JSON path.
Study read_study(const std::string& path);

/// A scenario from its JSON, as a study's "scenario" has it.
Scenario read_scenario(JsonObject object, const std::string& folder);

}  // namespace gyrostat
