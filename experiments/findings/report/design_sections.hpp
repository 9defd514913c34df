#pragma once

#include <string>
#include <vector>

#include <gyrostat/experiments/findings/cell_summary.hpp>
#include <gyrostat/experiments/findings/report/method_colours.hpp>
#include <gyrostat/experiments/findings/report/sweep.hpp>
#include <gyrostat/experiments/findings/sensitivity.hpp>

namespace gyrostat {

/// Whether the cell is a point that serves its design alone. The base of one_at_a_time is a cell
/// like any other.
bool serves_a_design(const Study& study, std::size_t cell);

/// Sensitivities of one design, the method with the least mean first.
using DesignSensitivities = std::vector<Sensitivity>;
std::vector<DesignSensitivities> by_design(const Study& study, const Store& store);

/// One section for all sweeps of a base, as of a one-at-a-time design.
std::string sweep_sections(const Study& study, const std::vector<Sweep>& sweeps,
                           const std::vector<CellSummary>& summaries, const MethodColours& colours);

/// What matters in each design, under the id "design-<its number>".
std::string sensitivity_sections(const std::vector<DesignSensitivities>& designs,
                                 const MethodColours& colours);

}  // namespace gyrostat
