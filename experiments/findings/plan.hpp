#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat {

/// What a cell, or all cells of a design, will cost.
struct CellPlan {
  std::size_t cells = 1, measured_cells = 1;
  std::uint32_t pilot_trials = 0;  ///< that the figures were measured on
  double steps = 0.0;              ///< of all filters in all trials
  double preparation_s = 0.0;      ///< calibration and tuning
  double trials_s = 0.0;           ///< all trials, their way into the store included
  double results_s = 0.0;          ///< tables and outcomes.csv.gz
  double store_bytes = 0.0;
  double export_bytes = 0.0;  ///< outcomes.csv.gz

  double seconds() const { return preparation_s + trials_s + results_s; }
  double bytes() const { return store_bytes + export_bytes; }
};

struct PilotOptions {
  int threads = 0;       ///< of the run that is planned; 0: as many as the machine has
  double seconds = 2.0;  ///< so long trials of the cell are run
};

/// Measures the first trials of a cell as `gyrostat run` would run them, into a store below
/// `folder`, and takes the rest in proportion; so is tuning, by a few of its evaluations.
CellPlan plan_cell(const Study& study, std::size_t cell, const std::filesystem::path& folder,
                   const PilotOptions& options);

/// The same of all points of a design, from its first, middle and last: preparation in proportion
/// to points, trials to their steps.
CellPlan plan_design(const Study& study, const Design& design, const std::filesystem::path& folder,
                     const PilotOptions& options);

}  // namespace gyrostat
