#pragma once

#include <string>
#include <vector>

#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat {

/// A number that a cell depends on, by its path in the cell's JSON.
struct CellParameter {
  std::string path;
  double value = no_value;  ///< NaN for a filter's that a calibration gives
  std::string unit;
  Range range;
};

/// Every parameter of a cell that has a field list: of its scenario, its effects (by index and by
/// name) and its filters (by index and by id).
std::vector<CellParameter> cell_parameters(const Cell& cell);

/// The one at `path`; InputError at `place` with the nearest known path otherwise.
CellParameter parameter_at(const Cell& cell, const std::string& path, const std::string& place);

}  // namespace gyrostat
