#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <gyrostat/core/series.hpp>

namespace gyrostat {

/// A column to be written.
struct CsvColumn {
  std::string name;
  std::span<const double> values;           ///< NaN becomes a blank cell
  std::span<const std::string_view> texts;  ///< used when `values` is empty
};

/// Writes columns of equal length with 17 significant digits, packed when the name ends in .gz, as
/// `write_atomically` does. Throws InputError when the file cannot be written.
void write_csv(const std::filesystem::path& path, std::span<const CsvColumn> columns);

/// Writes columns of equal length as MATLAB file where the name ends in .mat, as CSV elsewhere.
void write_columns(const std::filesystem::path& path, std::span<const CsvColumn> columns);

/// Writes every channel that is present, so that `read_recording` returns the same bits.
void write_series(const std::filesystem::path& path, const Series& series);

}  // namespace gyrostat
