#include <gyrostat/recordings/write_columns.hpp>

#include <cassert>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include <gyrostat/recordings/atomic_file.hpp>
#include <gyrostat/recordings/matlab.hpp>

namespace gyrostat {
namespace {

std::size_t rows_of(const CsvColumn& column) {
  return column.values.empty() ? column.texts.size() : column.values.size();
}

/// Quoted where RFC 4180 asks for it.
std::string text_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) cell.append(c == '"' ? 2 : 1, c);
  return cell + '"';
}

}  // namespace

void write_csv(const std::filesystem::path& path, std::span<const CsvColumn> columns) {
  const auto separator = [&](const CsvColumn& column) {
    return &column == &columns.back() ? '\n' : ',';
  };
  const std::size_t rows = columns.empty() ? 0 : rows_of(columns.front());
  std::string text;
  for (const auto& column : columns) {
    assert(rows_of(column) == rows);
    text += text_cell(column.name) + separator(column);
  }
  for (std::size_t row = 0; row < rows; ++row) {
    for (const auto& column : columns) {
      if (column.values.empty()) {
        text += text_cell(column.texts[row]);
      } else if (!std::isnan(column.values[row])) {
        fmt::format_to(std::back_inserter(text), "{:.17g}", column.values[row]);
      }
      text += separator(column);
    }
  }
  write_atomically(path, path.extension() == ".gz" ? gzipped(text) : text);
}

void write_columns(const std::filesystem::path& path, std::span<const CsvColumn> columns) {
  path.extension() == ".mat" ? write_mat(path, columns) : write_csv(path, columns);
}

void write_series(const std::filesystem::path& path, const Series& series) {
  std::vector<CsvColumn> columns;
  for (const auto& channel : channels) {
    const auto& values = series.*channel.values;
    if (!values.empty()) columns.push_back({std::string(channel.name), values, {}});
  }
  write_columns(path, columns);
}

}  // namespace gyrostat
