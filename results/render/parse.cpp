#include <nlohmann/json.hpp>

#include <gyrostat/core/error.hpp>
#include <gyrostat/results/render/render.hpp>

namespace gyrostat {
namespace {

using nlohmann::ordered_json;

TableCell parsed(const ordered_json& cell) {
  if (cell.is_null()) return {};
  if (cell.is_string()) return cell.get<std::string>();
  if (cell.is_number_integer()) return cell.get<std::int64_t>();
  return cell.get<double>();
}

}  // namespace

std::vector<Table> parse_tables(const std::string& json, const std::string& place) try {
  std::vector<Table> tables;
  for (const auto& in : ordered_json::parse(json)) {
    Table& out = tables.emplace_back();
    out.title = in.at("title");
    for (const auto& column : in.at("columns"))
      out.columns.push_back({column.at("name"), column.at("unit")});
    for (const auto& row : in.at("rows")) {
      if (row.size() != out.columns.size())
        throw InputError(place, "a row of '" + out.title + "' has not as many cells as columns");
      auto& cells = out.rows.emplace_back();
      for (const auto& cell : row) cells.push_back(parsed(cell));
    }
    for (const auto& note : in.at("notes")) out.notes.push_back(note);
  }
  return tables;
} catch (const ordered_json::exception&) {
  throw InputError(place, "does not hold tables as \"--format json\" writes them");
}

}  // namespace gyrostat
