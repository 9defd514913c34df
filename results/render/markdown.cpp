#include <gyrostat/results/render/render.hpp>

namespace gyrostat::render_detail {
namespace {

std::string escaped(const std::string& s) {
  std::string out;
  for (const char c : s) {
    if (c == '|' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

}  // namespace

std::string markdown(const Table& table) {
  std::string out = "**" + escaped(one_line(table.title)) + "**\n\n|";
  for (const auto& column : table.columns) out += ' ' + escaped(head(column)) + " |";
  out += "\n|";
  for (std::size_t c = 0; c < table.columns.size(); ++c) out += c == 0 ? " --- |" : " ---: |";
  out += '\n';
  for (const auto& row : table.rows) {
    out += '|';
    for (std::size_t c = 0; c < row.size(); ++c)
      out += ' ' + escaped(readable(row[c], table.columns[c])) + " |";
    out += '\n';
  }
  for (const auto& note : table.notes) out += "\n" + escaped(one_line(note)) + '\n';
  return out;
}

}  // namespace gyrostat::render_detail
