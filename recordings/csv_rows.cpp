#include <gyrostat/recordings/csv_rows.hpp>

#include <algorithm>
#include <cmath>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/recordings/calendar.hpp>
#include <gyrostat/recordings/csv_cells.hpp>
#include <gyrostat/recordings/text.hpp>

namespace gyrostat {
namespace {

using namespace csv_cells;

bool is_infinite(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return text == "inf" || text == "Inf" || text == "INF" || text == "Infinity" ||
         text == "infinity";
}

/// What programs write for a number that is none.
bool is_no_number(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  for (const std::string_view word : {"nan", "NaN", "NAN", "Nan", "NA", "N/A", "null", "None"})
    if (text == word) return true;
  return false;
}

}  // namespace

struct CsvRows::Row {
  std::string_view cells, place;
  std::size_t line;

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("{}:{}", place, line), problem);
  }
};

CsvRows::CsvRows(const CsvHeader& header, std::span<std::vector<double>* const> targets,
                 std::string_view place, const std::vector<double>* times)
    : header_(header),
      targets_(targets.begin(), targets.end()),
      place_(place),
      times_(times),
      line_(header.first_row) {}

/// A cell that is not just a number: blank, padded, quoted, with a plus sign or a decimal comma, no
/// number by its own word, a date, or wrong.
double CsvRows::odd_cell(std::string_view cell, std::size_t column, const Row& row) {
  std::string_view number = trimmed(cell);
  if (number.empty() || is_no_number(number)) return no_value;
  if (is_infinite(number)) {
    if (oddities_.infinite++ == 0) oddities_.infinite_line = row.line;
    return no_value;
  }
  const bool is_time = times_ != nullptr && targets_[column] == times_;
  if (const auto moment = is_time ? seconds_of_calendar(number) : std::nullopt) {
    oddities_.calendar_times = true;
    return *moment;
  }
  if (number.starts_with('+') && !number.starts_with("+-")) number.remove_prefix(1);
  if (const auto value = number_in(number)) return *value;
  if (const auto value = number_in(number, ','); value && header_.separator != ',') return *value;
  row.fail(
      fmt::format("column '{}': '{}' is not a number; allowed: finite numbers{}, or a blank "
                  "cell or NaN for no value",
                  printable(header_.names[column]), shown(cell),
                  is_time ? ", dates as 2026-01-31T23:59:59.5" : ""));
}

void CsvRows::read_row(const Row& row) {
  const char separator = header_.separator;
  const char* cell = row.cells.data();
  const char* const row_end = cell + row.cells.size();
  const std::size_t count = header_.names.size();
  for (std::size_t i = 0; i < count; ++i) {
    cell = cell_begin(cell, row_end, separator);
    const char* end = nullptr;
    if (targets_[i]) {
      double value = no_value;
      const auto [stop, error] = fast_float::from_chars(cell, row_end, value);
      end = stop;
      if (error != std::errc() || (end != row_end && !separates(*end, separator)) ||
          !std::isfinite(value)) {
        end = cell_end(cell, row_end, separator);
        value = odd_cell({cell, static_cast<std::size_t>(end - cell)}, i, row);
      }
      targets_[i]->push_back(value);
    } else {
      end = cell_end(cell, row_end, separator);
    }
    if ((end == row_end) != (i + 1 == count)) {
      const auto cells = separator == ' '
                             ? static_cast<std::ptrdiff_t>(cells_of(row.cells, ' ').size())
                             : std::count(row.cells.begin(), row.cells.end(), separator) + 1;
      row.fail(fmt::format("'{}' has {} cells; allowed: {}, as many as the header",
                           shown(row.cells), cells, count));
    }
    cell = end + 1;
  }
}

void CsvRows::feed(std::string_view lines) {
  for (; !lines.empty(); ++line_) {
    Row row{take(lines, '\n'), place_, line_};
    if (row.cells.ends_with('\r')) row.cells.remove_suffix(1);
    if (header_.separator == ' ')
      while (row.cells.ends_with(' ') || row.cells.ends_with('\t')) row.cells.remove_suffix(1);
    if (trimmed(row.cells).empty()) {
      if (blank_ == 0) blank_ = line_;
      continue;
    }
    if (blank_ > 0) Row{{}, place_, blank_}.fail("is blank; allowed: blank lines at the end only");
    read_row(row);
  }
}

}  // namespace gyrostat
