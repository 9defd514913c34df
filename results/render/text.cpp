#include <algorithm>
#include <set>

#include <gyrostat/results/render/render.hpp>

namespace gyrostat::render_detail {
namespace {

constexpr std::size_t screen = 80, indent = 2, gap = 3;
/// A text is not broken into lines shorter than this.
constexpr std::size_t least_text = 24;
/// Columns that tell rows apart leave the others at least as much.
constexpr std::size_t most_of_key = 45;

/// Characters that a terminal shows: UTF-8 continuation bytes are not.
std::size_t width(const std::string& s) {
  return static_cast<std::size_t>(
      std::count_if(s.begin(), s.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// The text in lines of at most `most` characters, broken at blanks; a longer word stays whole.
std::vector<std::string> broken(const std::string& text, std::size_t most) {
  std::vector<std::string> lines = {""};
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto end = std::min(text.find(' ', begin), text.size());
    const auto word = text.substr(begin, end - begin);
    if (!lines.back().empty() && width(lines.back()) + 1 + width(word) > most)
      lines.push_back(word);
    else
      lines.back() += (begin == 0 ? "" : " ") + word;
    begin = end + 1;
  }
  return lines;
}

/// A table as texts, its heads in line 0.
struct Grid {
  std::vector<std::vector<std::string>> lines;
  std::vector<bool> left;
  std::vector<std::size_t> widths;
};

Grid grid_of(const Table& table) {
  Grid grid{.lines = {{}},
            .left = std::vector<bool>(table.columns.size(), true),
            .widths = std::vector<std::size_t>(table.columns.size(), 0)};
  for (const auto& column : table.columns) grid.lines[0].push_back(head(column));
  for (const auto& row : table.rows) {
    auto& line = grid.lines.emplace_back();
    for (std::size_t c = 0; c < row.size(); ++c) {
      line.push_back(readable(row[c], table.columns[c]));
      grid.left[c] = grid.left[c] && std::holds_alternative<std::string>(row[c]);
    }
  }
  for (const auto& line : grid.lines)
    for (std::size_t c = 0; c < line.size(); ++c)
      grid.widths[c] = std::max(grid.widths[c], width(line[c]));
  return grid;
}

/// How many of the first columns say what a row is about: as many as tell rows apart, where these
/// leave room for others.
std::size_t key_columns(const Grid& grid) {
  std::size_t used = 0;
  for (std::size_t count = 1; count < grid.widths.size(); ++count) {
    used += gap + grid.widths[count - 1];
    if (used > most_of_key) break;
    std::set<std::vector<std::string>> keys;
    for (const auto& line : grid.lines)
      keys.emplace(line.begin(),
                   line.begin() + static_cast<std::ptrdiff_t>(std::min(count, line.size())));
    if (keys.size() == grid.lines.size()) return count;
  }
  return grid.widths.size() < 2 || !grid.left[1] ? 1 : 2;
}

using Columns = std::vector<std::size_t>;

/// Sets of columns that fit side by side, each with the key; texts are given the room that is left.
std::vector<Columns> parts_of(Grid& grid) {
  const auto room_for = [&](std::size_t used, std::size_t c) {
    return used == 0 ? indent + grid.widths[c] : used + gap + grid.widths[c];
  };
  Columns key;
  std::size_t key_width = 0, all = 0;
  for (std::size_t c = 0; c < grid.widths.size(); ++c) all = room_for(all, c);
  for (std::size_t c = 0; c < grid.widths.size() && all > screen && c < key_columns(grid); ++c) {
    key.push_back(c);
    key_width = room_for(key_width, c);
  }
  std::vector<Columns> parts = {key};
  std::size_t used = key_width;
  for (std::size_t c = key.size(); c < grid.widths.size(); ++c) {
    if (all > screen && room_for(used, c) > screen) {
      const auto left = screen - std::min(screen, used + gap);
      if (!grid.left[c] || left < least_text) {
        if (parts.back().size() > key.size()) parts.push_back(key);
        used = key_width;
      }
      if (grid.left[c] && room_for(used, c) > screen)
        grid.widths[c] = std::max(least_text, screen - std::min(screen, used + gap));
    }
    parts.back().push_back(c);
    used = room_for(used, c);
  }
  return parts;
}

std::string line_of(const Grid& grid, const std::vector<std::string>& cells,
                    const Columns& columns) {
  std::vector<std::vector<std::string>> broken_cells;
  std::size_t height = 1;
  for (const auto c : columns) {
    const auto cell = c < cells.size() ? cells[c] : std::string();
    broken_cells.push_back(width(cell) > grid.widths[c] ? broken(cell, grid.widths[c])
                                                        : std::vector<std::string>{cell});
    height = std::max(height, broken_cells.back().size());
  }
  std::string out;
  for (std::size_t l = 0; l < height; ++l) {
    std::string row;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const auto text = l < broken_cells[i].size() ? broken_cells[i][l] : std::string();
      const auto room = grid.widths[columns[i]];
      const std::string padding(room - std::min(room, width(text)), ' ');
      row += std::string(i == 0 ? indent : gap, ' ');
      row += grid.left[columns[i]] ? text + padding : padding + text;
    }
    out += row.substr(0, row.find_last_not_of(' ') + 1) + '\n';
  }
  return out;
}

}  // namespace

/// A table that is wider than a screen stands in parts, one below the other, each with its first
/// columns; a long text is broken within its column.
std::string text(const Table& table) {
  auto grid = grid_of(table);
  std::string out = wrapped(one_line(table.title), indent);
  const auto parts = parts_of(grid);
  for (const auto& columns : parts) {
    if (&columns != &parts.front()) out += '\n';
    for (const auto& line : grid.lines) out += line_of(grid, line, columns);
  }
  for (const auto& note : table.notes)
    out += wrapped(std::string(indent, ' ') + one_line(note), indent);
  return out;
}

}  // namespace gyrostat::render_detail

namespace gyrostat {

std::string wrapped(const std::string& text, std::size_t further_in) {
  std::string out;
  for (std::size_t begin = 0; begin < std::max<std::size_t>(1, text.size());) {
    const auto end = std::min(text.find('\n', begin), text.size());
    const auto before = std::min(text.find_first_not_of(' ', begin), end) - begin;
    const auto line = text.substr(begin + before, end - begin - before);
    const bool fits = before + render_detail::width(line) <= render_detail::screen;
    const auto most = render_detail::screen - before - (fits ? 0 : further_in);
    bool is_first = true;
    for (const auto& part : render_detail::broken(line, most)) {
      if (!part.empty()) out += std::string(before + (is_first ? 0 : further_in), ' ') + part;
      out += '\n';
      is_first = false;
    }
    begin = end + 1;
  }
  return out;
}

}  // namespace gyrostat
