#include "experiments/grid.hpp"

namespace gyrostat {
namespace {

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t dot; (dot = path.find('.', begin)) != std::string::npos; begin = dot + 1)
    parts.push_back(path.substr(begin, dot - begin));
  parts.push_back(path.substr(begin));
  return parts;
}

Json& step_into(Json& json, const std::string& part, const std::string& path,
                const std::string& place) {
  if (json.is_array()) {
    const bool is_index = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
    if (is_index && part.size() < 6 && std::stoul(part) < json.size()) return json[std::stoul(part)];
    throw InputError(place, fmt::format("'{}' in {} is not an index of a list of {}", part, path,
                                        json.size()));
  }
  if (!json.is_object() && !json.is_null())
    throw InputError(place, fmt::format("{} leads through {}, which has no parts", path, json.dump()));
  return json[part];
}

}  // namespace

void set_at(Json& json, const std::string& path, const Json& value, const std::string& place) {
  Json* at = &json;
  for (const auto& part : split(path)) at = &step_into(*at, part, path, place);
  *at = value;
}

std::vector<std::pair<Json, std::string>> expand_grid(const Json& cell, const std::string& place) {
  if (!cell.is_object() || !cell.contains("grid")) return {{cell, place}};
  const Json& grid = cell.at("grid");
  const std::string here = place + ".grid";
  if (!grid.is_object()) throw InputError(here, "an object {\"path\": [values]} is needed here");
  Json base = cell;
  base.erase("grid");
  const std::string name = JsonObject(base, place).text("name", "cell");

  std::vector<std::pair<Json, std::string>> cells = {{base, ""}};
  for (const auto& [path, values] : grid.items()) {
    if (!values.is_array() || values.empty())
      throw InputError(here + "." + path, "a list of values [...] is needed here");
    std::vector<std::pair<Json, std::string>> next;
    for (const auto& [json, label] : cells)
      for (const auto& value : values) {
        auto& [varied, varied_label] = next.emplace_back(json, label);
        set_at(varied, path, value, here);
        varied_label += (label.empty() ? "" : ",") + split(path).back() + "=" +
                        (value.is_string() ? value.get<std::string>() : value.dump());
      }
    cells = std::move(next);
  }
  for (auto& [json, label] : cells) {
    json["name"] = name + "[" + label + "]";
    label = place + "[" + label + "]";
  }
  return cells;
}

}  // namespace gyrostat
