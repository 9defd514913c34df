#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace gyrostat {

/// What stands in one place of a table; monostate where there is nothing to say.
using TableCell = std::variant<std::monostate, std::string, double, std::int64_t>;

struct TableColumn {
  std::string name;
  std::string unit;  ///< empty for text and plain counts
};

/// A result: a title, columns with units, rows, and notes to be read with them.
struct Table {
  std::string title;
  std::vector<TableColumn> columns;
  std::vector<std::vector<TableCell>> rows{};
  std::vector<std::string> notes{};
};

/// A table under the name that pages and files call it by.
struct NamedTable {
  std::string name;
  Table table;
};

/// A number, or an empty cell for NaN.
inline TableCell cell(double value) { return value == value ? TableCell(value) : TableCell(); }

/// "3/100".
inline TableCell out_of(std::size_t count, std::size_t total) {
  return std::to_string(count) + "/" + std::to_string(total);
}

}  // namespace gyrostat
