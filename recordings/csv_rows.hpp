#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include <gyrostat/recordings/csv_header.hpp>

namespace gyrostat {

/// What is in the rows of a CSV and is no plain number.
struct CsvOddities {
  std::size_t infinite = 0;       ///< values taken as missing
  std::size_t infinite_line = 0;  ///< of the first
  bool calendar_times = false;    ///< times were dates: they count from 1970 in seconds
};

/// The rows below a header, fed in blocks of whole lines. Column i is appended to `*targets[i]`, or
/// skipped where that is null. A blank cell, NaN, NA, null, and an infinity are no value; where
/// commas do not separate they may be decimal; `times` may hold dates (ISO 8601). Throws InputError
/// with line, column and value for a cell that is none of these, a row of another length than the
/// header, and a blank line that is not at the end.
class CsvRows {
 public:
  CsvRows(const CsvHeader& header, std::span<std::vector<double>* const> targets,
          std::string_view place, const std::vector<double>* times = nullptr);
  void feed(std::string_view lines);
  const CsvOddities& oddities() const { return oddities_; }

 private:
  struct Row;
  void read_row(const Row& row);
  double odd_cell(std::string_view cell, std::size_t column, const Row& row);

  const CsvHeader& header_;
  std::vector<std::vector<double>*> targets_;
  std::string_view place_;
  const std::vector<double>* times_;
  std::size_t line_, blank_ = 0;
  CsvOddities oddities_;
};

}  // namespace gyrostat
