#include <gyrostat/results/render/render.hpp>

namespace gyrostat::render_detail {
namespace {

/// RFC 4180 quoting.
std::string quoted(const std::string& s) {
  if (s.find_first_of(",\"\n\r") == std::string::npos) return s;
  std::string out = "\"";
  for (const char c : s) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

}  // namespace

std::string csv(const Table& table) {
  std::string out = "# " + one_line(table.title) + '\n';
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    out += (c == 0 ? "" : ",") + quoted(head(table.columns[c]));
  out += '\n';
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) out += (c == 0 ? "" : ",") + quoted(exact(row[c]));
    out += '\n';
  }
  for (const auto& note : table.notes) out += "# note: " + one_line(note) + '\n';
  return out;
}

}  // namespace gyrostat::render_detail
