#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/experiments/pages/page.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/results/pictures/colours.hpp>
#include <gyrostat/results/pictures/picture.hpp>
#include <gyrostat/results/render/render.hpp>

namespace gyrostat {
namespace {

double number(const TableCell& cell) {
  if (const auto* value = std::get_if<double>(&cell)) return *value;
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*count);
  return no_value;
}

std::size_t column_named(const Table& table, const std::string& name, const std::string& place) {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (table.columns[c].name == name) return c;
    names.push_back(table.columns[c].name);
  }
  throw InputError(place, unknown_name("column", name, names));
}

std::vector<double> values_of(const Table& table, const std::string& name,
                              const std::string& place) {
  const std::size_t column = column_named(table, name, place);
  std::vector<double> values;
  for (const auto& row : table.rows) values.push_back(number(row[column]));
  return values;
}

/// y ± 2 "std of y" where the table has that, else the bounds "lower y" and "upper y".
void add_band(const Table& table, const std::string& name, const std::string& place, Mark& line) {
  const auto has = [&](const std::string& column) {
    return std::any_of(table.columns.begin(), table.columns.end(),
                       [&](const TableColumn& c) { return c.name == column; });
  };
  if (has("std of " + name)) {
    const auto spread = values_of(table, "std of " + name, place);
    for (std::size_t i = 0; i < spread.size(); ++i) {
      line.y_low.push_back(line.y[i] - 2.0 * spread[i]);
      line.y_high.push_back(line.y[i] + 2.0 * spread[i]);
    }
  } else if (has("lower " + name)) {
    line.y_low = values_of(table, "lower " + name, place);
    line.y_high = values_of(table, "upper " + name, place);
  }
}

bool is_bound(const std::string& name) {
  const auto* filter = filter_types().find(name);
  return filter != nullptr && filter->role.is_bound();
}

/// Of a filter that does nothing and of a bound their own, as in reports; of all others the next.
std::string colour_of(const std::string& name, std::size_t& next) {
  const auto* filter = filter_types().find(name);
  if (filter != nullptr && filter->role.is_floor()) return "none";
  if (is_bound(name)) return "oracle";
  return fmt::format("m{}", next++ % 8);
}

Picture lines(JsonObject& object, const Table& table, const std::string& title,
              const std::vector<std::string>& methods) {
  const auto& first = table.columns.front();
  Picture picture{.title = title,
                  .x = {.label = first.name, .unit = first.unit},
                  .y = {.label = object.text("y_label", "")}};
  picture.x.logarithmic = picture.y.logarithmic =
      object.number("logarithmic", 0, ranges::flag, "") != 0.0;
  picture.panels = object.number("panels", 0, ranges::flag, "") != 0.0;
  const auto x = values_of(table, first.name, object.place());
  std::size_t next = 0;
  for (const auto& name : methods) {
    auto& line = picture.marks.emplace_back();
    line.name = name;
    line.colour = colour_of(name, next);
    line.x = x;
    line.y = values_of(table, name, object.place());
    add_band(table, name, object.place(), line);
  }
  return picture;
}

/// "grid[a=1,b=2]" as "a=1, b=2".
std::string short_label(const std::string& cell) {
  const auto open = cell.find('[');
  if (open == std::string::npos || !cell.ends_with(']')) return cell;
  std::string label;
  for (const char c : cell.substr(open + 1, cell.size() - open - 2)) {
    label += c;
    if (c == ',') label += ' ';
  }
  return label;
}

/// The ratio of each number to the least of its row, bounds left out of both.
Picture heat_map(JsonObject& object, const Table& table, const std::string& title,
                 const std::vector<std::string>& methods) {
  Picture picture{
      .title = title,
      .note = "bold: lowest of its row; colour: ratio to it, 1 (white) to 10 and above (red)"};
  picture.x.names = methods;
  Mark least, others;
  least.kind = others.kind = Mark::Kind::cells;
  least.strong = true;
  for (const auto& row : table.rows) {
    std::vector<double> values;
    double best = HUGE_VAL;
    for (const auto& name : methods) {
      values.push_back(number(row[column_named(table, name, object.place())]));
      if (!is_bound(name) && values.back() < best) best = values.back();
    }
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const bool bound = is_bound(methods[m]);
      auto& cells = !bound && values[m] == best ? least : others;
      cells.x.push_back(static_cast<double>(m));
      cells.y.push_back(static_cast<double>(picture.y.names.size()));
      cells.labels.push_back(std::isfinite(values[m]) ? fmt::format("{:.3g}", values[m]) : "–");
      cells.fills.push_back(bound ? "#eeeeee" : ratio_colour(values[m] / best));
    }
    picture.y.names.push_back(short_label(render_detail::readable(row.front())));
  }
  picture.marks = {std::move(others), std::move(least)};
  return picture;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> page_figures(
    const Page& page, const std::vector<NamedTable>& tables) {
  std::vector<std::pair<std::string, std::string>> files;
  for (std::size_t i = 0; i < page.figures.size(); ++i) {
    JsonObject object(page.figures[i], fmt::format("{}: figures[{}]", page.folder, i));
    const auto name = object.required_text("name"), kind = object.required_text("kind");
    const auto wanted = object.required_text("table");
    const auto at = std::find_if(tables.begin(), tables.end(),
                                 [&](const NamedTable& t) { return t.name == wanted; });
    if (at == tables.end()) throw InputError(object.place(), "there is no table '" + wanted + "'");
    const auto title = object.text("title", at->table.title);
    std::vector<std::string> methods;
    for (const auto& [value, place] : object.list("methods")) methods.push_back(value->dump());
    for (auto& method : methods)
      method.erase(std::remove(method.begin(), method.end(), '"'), method.end());
    Picture picture;
    if (kind == "lines")
      picture = lines(object, at->table, title, methods);
    else if (kind == "heat")
      picture = heat_map(object, at->table, title, methods);
    else
      throw InputError(
          object.place_of("kind"),
          unknown_name("kind of figure", kind, std::vector<std::string>{"lines", "heat"}));
    object.finish();
    files.emplace_back(name + ".svg", picture_file(picture));
  }
  return files;
}

}  // namespace gyrostat
