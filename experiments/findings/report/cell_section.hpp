#pragma once

#include <string>

#include <gyrostat/experiments/findings/report/cell_view.hpp>
#include <gyrostat/experiments/run/runner.hpp>

namespace gyrostat {

/// One cell in full: sentences, ranking, pictures, worst trials, tables. `replayed` has no trials
/// where none were simulated again.
std::string cell_section(const CellView& view, const CellRanking& ranking,
                         const PreparedCell& prepared, const Replayed& replayed,
                         const std::map<std::string, double>& nanoseconds);

}  // namespace gyrostat
