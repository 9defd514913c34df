#include <algorithm>
#include <cmath>

#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/experiments/pages/page.hpp>
#include <gyrostat/results/render/figure.hpp>
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
void add_band(const Table& table, const std::string& name, const std::string& place,
              LineChart::Line& line) {
  const auto has = [&](const std::string& column) {
    return std::any_of(table.columns.begin(), table.columns.end(),
                       [&](const TableColumn& c) { return c.name == column; });
  };
  if (has("std of " + name)) {
    const auto spread = values_of(table, "std of " + name, place);
    for (std::size_t i = 0; i < spread.size(); ++i) {
      line.low.push_back(line.y[i] - 2.0 * spread[i]);
      line.high.push_back(line.y[i] + 2.0 * spread[i]);
    }
  } else if (has("lower " + name)) {
    line.low = values_of(table, "lower " + name, place);
    line.high = values_of(table, "upper " + name, place);
  }
}

std::string line_chart(JsonObject& object, const Table& table, const std::string& title,
                       const std::vector<std::string>& methods) {
  LineChart chart{.title = title,
                  .x_label = render_detail::head(table.columns.front()),
                  .y_label = object.text("y_label", ""),
                  .lines = {},
                  .logarithmic = object.number("logarithmic", 0, ranges::flag, "") != 0.0,
                  .panels = object.number("panels", 0, ranges::flag, "") != 0.0};
  const auto x = values_of(table, table.columns.front().name, object.place());
  for (const auto& name : methods) {
    auto& line = chart.lines.emplace_back();
    line.name = name;
    line.x = x;
    line.y = values_of(table, name, object.place());
    add_band(table, name, object.place(), line);
  }
  return svg(chart);
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

std::string heat_map(JsonObject& object, const Table& table, const std::string& title,
                     const std::vector<std::string>& methods) {
  HeatMap map{.title = title, .rows = {}, .columns = methods, .values = {}, .ranked = {}};
  for (const auto& name : methods) {
    const auto* filter = filter_types().find(name);
    map.ranked.push_back(filter == nullptr || !filter->role.is_bound());
  }
  for (const auto& row : table.rows) {
    map.rows.push_back(short_label(render_detail::readable(row.front())));
    auto& values = map.values.emplace_back();
    for (const auto& name : methods)
      values.push_back(number(row[column_named(table, name, object.place())]));
  }
  return svg(map);
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
    std::string text;
    if (kind == "lines")
      text = line_chart(object, at->table, title, methods);
    else if (kind == "heat")
      text = heat_map(object, at->table, title, methods);
    else
      throw InputError(
          object.place_of("kind"),
          unknown_name("kind of figure", kind, std::vector<std::string>{"lines", "heat"}));
    object.finish();
    files.emplace_back(name + ".svg", std::move(text));
  }
  return files;
}

}  // namespace gyrostat
