#include <gyrostat/recordings/csv_cells.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fast_float/fast_float.h>

#include <gyrostat/core/values.hpp>
#include <gyrostat/recordings/text.hpp>

namespace gyrostat::csv_cells {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n\"";
  const auto first = std::min(text.find_first_not_of(blanks), text.size());
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::string_view take(std::string_view& text, char separator) {
  const auto end = std::min(text.find(separator), text.size());
  const auto piece = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return piece;
}

const char* cell_end(const char* begin, const char* row_end, char separator) {
  constexpr std::string_view blanks = " \t";
  if (separator == ' ') return std::find_first_of(begin, row_end, blanks.begin(), blanks.end());
  const void* comma = std::memchr(begin, separator, static_cast<std::size_t>(row_end - begin));
  return comma ? static_cast<const char*>(comma) : row_end;
}

std::string shown(std::string_view text) {
  return printable(text.size() > 40 ? std::string(text.substr(0, 40)) + "..." : text);
}

std::vector<std::string> cells_of(std::string_view line, char separator) {
  if (separator == ' ') line = trimmed(line);
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::vector<std::string> cells;
  const char* cell = line.data();
  const char* const end = cell + line.size();
  while (true) {
    cell = cell_begin(cell, end, separator);
    const char* stop = cell_end(cell, end, separator);
    cells.emplace_back(trimmed({cell, static_cast<std::size_t>(stop - cell)}));
    if (stop == end) return cells;
    cell = stop + 1;
  }
}

std::optional<double> number_in(std::string_view text, char decimal_point) {
  double value = no_value;
  const char* end = text.data() + text.size();
  const auto [stop, error] = fast_float::from_chars_advanced(
      text.data(), end, value,
      fast_float::parse_options{fast_float::chars_format::general, decimal_point});
  return error == std::errc() && stop == end && std::isfinite(value) ? std::optional(value)
                                                                     : std::nullopt;
}

}  // namespace gyrostat::csv_cells
