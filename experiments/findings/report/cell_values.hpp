#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gyrostat/experiments/findings/cell_summary.hpp>
#include <gyrostat/results/store.hpp>

namespace gyrostat {

/// The judging metric in every finished trial of a cell; NaN where a method has no value.
struct CellValues {
  std::string metric{}, title{}, unit{};
  std::vector<std::uint32_t> trials{};        ///< in order
  std::vector<std::vector<double>> values{};  ///< by method, by finished trial
};

CellValues cell_values(const Cell& cell, const Store& store, std::uint32_t index);

/// The finished trials of a cell, for `summarise_cell` and `rank_cell`.
TrialSource trials_of(const Cell& cell, const Store& store, std::uint32_t index);

/// Methods by mean of the judging metric, the least first; the oracle last, and those without a
/// mean.
std::vector<std::size_t> best_first(const Cell& cell, const CellSummary& summary);

/// Finished trials of a method, the worst `count`, worst first: as places in `values`.
std::vector<std::size_t> worst_trials(const std::vector<double>& values, std::size_t count);

}  // namespace gyrostat
