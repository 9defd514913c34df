#pragma once

#include <string>
#include <vector>

#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat {

/// Cells that are one cell at several values of some parameters: those named "base[a=1,b=2]".
struct Sweep {
  std::string name;
  std::vector<std::string> parameters;           ///< those that vary
  std::vector<std::size_t> cells;                ///< as indices into the study
  std::vector<std::vector<std::string>> values;  ///< by cell, by parameter

  /// The values of a parameter: numbers in order of size, texts as they come.
  std::vector<std::string> levels(std::size_t parameter) const;
};

std::vector<Sweep> sweeps_of(const Study& study);

}  // namespace gyrostat
