#include <algorithm>

#include <gyrostat/results/render/render.hpp>

namespace gyrostat::render_detail {
namespace {

/// Characters that a terminal shows: UTF-8 continuation bytes are not.
std::size_t width(const std::string& s) {
  return static_cast<std::size_t>(
      std::count_if(s.begin(), s.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

bool is_text(const TableCell& cell) { return std::holds_alternative<std::string>(cell); }

}  // namespace

std::string text(const Table& table) {
  std::vector<std::vector<std::string>> lines;
  std::vector<bool> left(table.columns.size(), true);
  auto& heads = lines.emplace_back();
  for (const auto& column : table.columns) heads.push_back(head(column));
  for (const auto& row : table.rows) {
    auto& line = lines.emplace_back();
    for (std::size_t c = 0; c < row.size(); ++c) {
      line.push_back(readable(row[c]));
      left[c] = left[c] && is_text(row[c]);
    }
  }
  std::vector<std::size_t> widths(table.columns.size(), 0);
  for (const auto& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], width(line[c]));

  std::string out = one_line(table.title) + '\n';
  for (const auto& line : lines) {
    std::string row;
    for (std::size_t c = 0; c < line.size(); ++c) {
      const std::string padding(widths[c] - width(line[c]), ' ');
      row += c == 0 ? "  " : "   ";
      row += left[c] ? line[c] + padding : padding + line[c];
    }
    out += row.substr(0, row.find_last_not_of(' ') + 1) + '\n';
  }
  for (const auto& note : table.notes) out += "  " + one_line(note) + '\n';
  return out;
}

}  // namespace gyrostat::render_detail
