#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gyrostat {

/// What stands above the rows of a CSV.
struct CsvHeader {
  std::vector<std::string> names;
  std::vector<std::string> units;  ///< of a second line that has units, without brackets; or empty
  char separator = ',';            ///< or ';', a tab, or ' ' for blanks
  std::size_t line = 1;            ///< of the names, from 1
  std::size_t first_row = 2;       ///< line of the first row
  bool numbered = false;           ///< there are no names: columns are called 1, 2, …
};

/// Cuts the header off the front of a CSV, with a byte order mark and with lines of comment (#, %,
/// //) or nothing above it. Where the first other line is a row of numbers, the names are in the
/// last comment that has as many cells, and without one the columns are numbered from 1. Throws
/// InputError when a name appears twice or there are more than 10,000.
CsvHeader take_header(std::string_view& csv, std::string_view place);

}  // namespace gyrostat
