#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gyrostat {

/// The whole text of a file, a pipe, or a gzip of one or more members (known by its first bytes,
/// not by its name). Throws InputError when the file is missing, unreadable, a directory, empty,
/// not text (it holds a zero byte), a truncated or corrupt gzip, more than 1 GiB once unpacked or,
/// above 64 MiB, more than 100 times its size.
std::string read_text(const std::filesystem::path& path);

/// `text` from a file as ASCII that can go to a terminal or into JSON: any other byte becomes '?'.
std::string printable(std::string_view text);

/// What stands above the rows of a CSV.
struct CsvHeader {
  std::vector<std::string> names;
  std::vector<std::string> units;  ///< of a second line that has units, without brackets; or empty
  char separator = ',';            ///< or ';' or a tab
  std::size_t line = 1;            ///< of the names, from 1
  std::size_t first_row = 2;       ///< line of the first row
};

/// Cuts the header off the front of a CSV, with a byte order mark and with lines of comment (#, %,
/// //) or nothing above it. Where the first other line is a row of numbers, the names are in the
/// last comment. Throws InputError when a name appears twice or there are more than 10,000.
CsvHeader take_header(std::string_view& csv, std::string_view place);

/// Appends column i of the rows below a header to `*targets[i]`, or skips it where that is null. A
/// blank cell is NaN; where commas do not separate they may be decimal. Throws InputError with
/// line, column and value for a cell that is not a finite number, a row of another length than the
/// header, and a blank line that is not at the end.
void read_columns(std::string_view rows, const CsvHeader& header,
                  std::span<std::vector<double>* const> targets, std::string_view place);

}  // namespace gyrostat
