#include <gyrostat/experiments/study/design.hpp>

#include <array>
#include <cmath>

#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/json_path.hpp>

namespace gyrostat {

double DesignParameter::at(double u) const {
  if (range.whole) return std::min(to, from + std::floor(u * (to - from + 1.0)));
  if (u <= 0.0) return from;
  if (u >= 1.0) return to;
  return logarithmic ? from * std::pow(to / from, u) : from + u * (to - from);
}

double DesignParameter::coordinate(double value) const {
  return logarithmic ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
}

std::size_t DesignParameter::level_count() const {
  return range.whole ? static_cast<std::size_t>(to - from) + 1 : 0;
}

bool Design::is_sampled() const {
  constexpr std::size_t few = 20;
  return (kind != DesignKind::grid && kind != DesignKind::list) || values.size() > few;
}

std::string name_of(DesignKind kind) {
  constexpr std::array<std::string_view, all_design_kinds.size()> names = {
      "grid",          "list",   "latin_hypercube", "sobol",
      "one_at_a_time", "morris", "saltelli",        "surrogate"};
  return std::string(names[static_cast<std::size_t>(kind)]);
}

std::vector<std::pair<Json, std::string>> cells_of(const Design& design, const Json& cell,
                                                   const std::string& place) {
  Json base = cell;
  base.erase("grid");
  base.erase("design");
  const std::string key = cell.contains("grid") ? ".grid" : ".design";
  std::vector<std::pair<Json, std::string>> cells;
  for (std::size_t i = 0; i < design.values.size(); ++i) {
    auto& [varied, varied_place] = cells.emplace_back(base, place + "[" + design.labels[i] + "]");
    for (std::size_t p = 0; p < design.parameters.size(); ++p)
      if (const auto& value = design.values[i][p]; !value.empty())
        set_at(varied, design.parameters[p].path, Json::parse(value), place + key);
    varied["name"] = design.cell_name(i);
  }
  return cells;
}

}  // namespace gyrostat
