#pragma once

#include <span>
#include <string>
#include <vector>

#include <gyrostat/recordings/layout.hpp>

namespace gyrostat {

/// What the reader of a format makes of a file: named columns, and what the format knows of them.
struct ColumnTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;
  RecordingLayout layout;          ///< which column is which channel, in which unit
  std::vector<std::string> notes;  ///< what was chosen, left out or repaired

  void add(std::string name, std::vector<double> column);
  /// Moves column i to `*targets[i]` where that is not null; infinities become NaN, which is
  /// noted. Throws InputError at `place` where they are of unequal lengths.
  void take(std::span<std::vector<double>* const> targets, const std::string& place);
};

}  // namespace gyrostat
