#include <cmath>

#include <nlohmann/json.hpp>

#include <gyrostat/results/render/render.hpp>

namespace gyrostat::render_detail {
namespace {

using nlohmann::ordered_json;

struct ToJson {
  ordered_json operator()(std::monostate) const { return nullptr; }
  ordered_json operator()(double v) const {
    if (std::isnan(v)) return nullptr;
    return std::isinf(v) ? ordered_json(readable(v)) : ordered_json(v);
  }
  template <class T>
  ordered_json operator()(const T& v) const {
    return v;
  }
};

}  // namespace

std::string json(std::span<const Table> tables) {
  auto list = ordered_json::array();
  for (const auto& table : tables) {
    ordered_json out;
    out["title"] = table.title;
    out["columns"] = ordered_json::array();
    for (const auto& column : table.columns)
      out["columns"].push_back({{"name", column.name}, {"unit", column.unit}});
    out["rows"] = ordered_json::array();
    for (const auto& row : table.rows) {
      auto cells = ordered_json::array();
      for (const auto& cell : row) cells.push_back(std::visit(ToJson{}, cell));
      out["rows"].push_back(std::move(cells));
    }
    out["notes"] = table.notes;
    list.push_back(std::move(out));
  }
  return list.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace gyrostat::render_detail
