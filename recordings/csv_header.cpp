#include <gyrostat/recordings/csv_header.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/calendar.hpp>
#include <gyrostat/recordings/csv_cells.hpp>
#include <gyrostat/recordings/units.hpp>

namespace gyrostat {
namespace {

using namespace csv_cells;

constexpr std::size_t most_names = 10'000;

/// The commonest of comma, semicolon and tab; blanks where there is none of them.
char separator_of(std::string_view line) {
  char commonest = ',';
  for (const char candidate : {';', '\t'})
    if (std::count(line.begin(), line.end(), candidate) >
        std::count(line.begin(), line.end(), commonest))
      commonest = candidate;
  const bool blanks =
      std::count(line.begin(), line.end(), commonest) == 0 && trimmed(line).find(' ') != line.npos;
  return blanks ? ' ' : commonest;
}

/// How many characters make the line a comment: "#", "%" or "//"; 0 where it is none.
std::size_t comment_mark(std::string_view line) {
  return line.starts_with('#') || line.starts_with('%') ? 1 : line.starts_with("//") ? 2 : 0;
}

/// Whether cells are a row of values: the first that says anything is a number or a date.
bool is_row(const std::vector<std::string>& cells) {
  for (const auto& cell : cells)
    if (!cell.empty()) return number_in(cell) || number_in(cell, ',') || seconds_of_calendar(cell);
  return false;
}

/// The cells of a line that has a unit and no number, without brackets; nothing where it is
/// another.
std::vector<std::string> units_in(std::string_view line, const CsvHeader& header) {
  auto units = cells_of(line, header.separator);
  if (units.size() != header.names.size()) return {};
  bool has_unit = false;
  for (auto& unit : units) {
    if (number_in(unit) || number_in(unit, ',')) return {};
    if (const auto bare = split_unit(unit); bare.first.empty()) unit = bare.second;
    has_unit = has_unit || is_unit(unit);
    if (unit == "-") unit.clear();
  }
  return has_unit ? units : std::vector<std::string>{};
}

}  // namespace

CsvHeader take_header(std::string_view& csv, std::string_view place) {
  if (csv.starts_with("\xef\xbb\xbf")) csv.remove_prefix(3);
  CsvHeader header;
  std::string_view comment = "";
  for (; !csv.empty(); ++header.line) {
    auto rest = csv;
    const auto line = trimmed(take(rest, '\n'));
    const auto mark = comment_mark(line);
    if (!line.empty() && mark == 0) break;
    if (mark > 0) comment = line.substr(mark);
    csv = rest;
  }
  auto names = csv;
  const auto first = take(names, '\n');
  header.separator = separator_of(first);
  // "time (sec)" above single numbers is one name.
  const auto second = trimmed(names.substr(0, names.find('\n')));
  if (header.separator == ' ' && !second.empty() && second.find_first_of(" \t") == second.npos)
    header.separator = separator_of(second);
  const auto columns =
      static_cast<std::size_t>(std::count(first.begin(), first.end(), header.separator)) + 1;
  if (columns > most_names)
    throw InputError(fmt::format("{}:{}", place, header.line),
                     fmt::format("{} columns; allowed: up to {}", columns, most_names));
  header.names = cells_of(first, header.separator);
  if (is_row(header.names)) {
    auto commented = cells_of(comment, header.separator);
    header.numbered = commented.size() != header.names.size() || is_row(commented);
    header.first_row = header.line;
    if (header.numbered)
      for (std::size_t i = 0; i < header.names.size(); ++i) header.names[i] = std::to_string(i + 1);
    else
      header.names = std::move(commented);
    if (!header.numbered) --header.line;
  } else {
    csv = names;
    header.first_row = header.line + 1;
    auto rows = csv;
    header.units = units_in(take(rows, '\n'), header);
    if (!header.units.empty()) csv = rows;
    if (!header.units.empty()) ++header.first_row;
  }
  auto sorted = header.names;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
      twice != sorted.end() && !twice->empty()) {
    throw InputError(fmt::format("{}:{}", place, header.line),
                     fmt::format("column '{}' appears twice; allowed: once", shown(*twice)));
  }
  return header;
}

}  // namespace gyrostat
