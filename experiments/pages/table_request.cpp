#include <gyrostat/experiments/pages/table_request.hpp>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/experiments/findings/error_tables.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat::tabling {
namespace {

std::vector<std::string> texts(JsonObject& object, const std::string& key) {
  std::vector<std::string> all;
  for (const auto& [value, place] : object.list(key)) {
    if (!value->is_string()) throw InputError(place, "a text is needed here");
    all.push_back(value->get<std::string>());
  }
  return all;
}

/// Cells by name, or by the name of the grid that they came of.
std::vector<const Cell*> chosen_cells(const Study& study, JsonObject& object) {
  std::vector<const Cell*> cells;
  const auto names = texts(object, "cells");
  if (names.empty())
    for (const auto& cell : study.cells) cells.push_back(&cell);
  for (const auto& name : names) {
    const auto before = cells.size();
    for (const auto& cell : study.cells)
      if (cell.name == name || cell.name.starts_with(name + "[")) cells.push_back(&cell);
    if (cells.size() > before) continue;
    std::vector<std::string> known;
    for (const auto& cell : study.cells) known.push_back(cell.name);
    throw InputError(object.place_of("cells"), unknown_name("cell", name, known));
  }
  return cells;
}

}  // namespace

std::size_t index_of(const Cell& cell, const std::string& method, const std::string& place) {
  std::vector<std::string> ids;
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    if (cell.methods[m].id == method) return m;
    ids.push_back(cell.methods[m].id);
  }
  throw InputError(place, unknown_name("method", method, ids));
}

Request read_request(const Study& study, const Json& json, const std::string& place) {
  JsonObject object(json, place);
  Request request;
  request.name = object.required_text("name");
  request.kind = object.required_text("kind");
  request.title = object.text("title", request.name);
  request.cells = chosen_cells(study, object);
  request.methods = texts(object, "methods");
  request.than = texts(object, "than");
  for (const auto& metric : texts(object, "metrics"))
    request.metrics.push_back(metric_named(metric, object.place_of("metrics")));
  if (request.metrics.empty()) request.metrics.push_back(metric_named("bias_rmse", place));
  request.quantity = object.text("quantity", "rate");
  request.trial =
      static_cast<std::uint32_t>(object.number("trial", 0, Range{0, 1e6, false, false, true}, ""));
  request.points = static_cast<std::size_t>(object.number("points", 120, ranges::count, ""));
  object.finish();
  for (const auto* cell : request.cells) {
    for (const auto& method : request.methods) index_of(*cell, method, place);
    for (const auto& method : request.than) index_of(*cell, method, place);
  }
  return request;
}

std::vector<std::size_t> methods_of(const Request& request, const Cell& cell) {
  std::vector<std::size_t> methods;
  for (const auto& id : request.methods) methods.push_back(index_of(cell, id, request.name));
  if (methods.empty())
    for (std::size_t m = 0; m < cell.methods.size(); ++m) methods.push_back(m);
  return methods;
}

}  // namespace gyrostat::tabling
