#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The cells of a line of text that a header and its rows are made of. Blanks and tabs alike
/// separate where the separator is a blank, and any run of them is one.
namespace gyrostat::csv_cells {

/// `text` without blanks, ends of line and quotes around it.
std::string_view trimmed(std::string_view text);

/// Cuts `text` up to `separator` off its front.
std::string_view take(std::string_view& text, char separator);

inline bool separates(char c, char separator) {
  return c == separator || (separator == ' ' && c == '\t');
}

/// Where the cell that begins at `begin` ends.
const char* cell_end(const char* begin, const char* row_end, char separator);

/// Where the next cell begins: behind blanks where they separate.
inline const char* cell_begin(const char* begin, const char* row_end, char separator) {
  while (separator == ' ' && begin != row_end && (*begin == ' ' || *begin == '\t')) ++begin;
  return begin;
}

/// All cells of a line, trimmed.
std::vector<std::string> cells_of(std::string_view line, char separator);

/// The whole of `text` as a finite number, or nothing.
std::optional<double> number_in(std::string_view text, char decimal_point = '.');

/// What a message quotes of a cell or row: printable, and not long.
std::string shown(std::string_view text);

}  // namespace gyrostat::csv_cells
