#pragma once

#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/findings/cell_summary.hpp>
#include <gyrostat/experiments/run/runner.hpp>

namespace gyrostat {

/// The fitted calibration of a cell, with standard errors.
Table calibration_table(const Cell& cell, const Calibration& fit, const CellSummary& summary);

/// What tuning found, by method and parameter; no rows where nothing was tuned.
Table tuning_table(const Cell& cell, const std::vector<TunedMethod>& tuned);

/// Error statistics of a cell, one row a method: rate and bias RMSE, heading error, consistency.
/// Failures stand beside every mean; failed trials stay in it. Nothing in them depends on timing.
std::vector<Table> error_tables(const Cell& cell, const CellSummary& summary);

/// Nanoseconds per step of each method: measured, so different in every run.
Table timing_table(const Cell& cell, const std::vector<double>& nanoseconds_per_step);

}  // namespace gyrostat
