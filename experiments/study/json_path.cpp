#include <gyrostat/experiments/study/json_path.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

#include <fmt/format.h>

namespace gyrostat {
namespace {

/// By what an entry of a list may be called.
std::vector<std::string> names_of(const Json& entry) {
  std::vector<std::string> names;
  if (entry.is_string()) names.push_back(entry.get<std::string>());
  for (const char* key : {"id", "filter", "effect"})
    if (entry.is_object() && entry.contains(key) && entry.at(key).is_string())
      names.push_back(entry.at(key).get<std::string>());
  return names;
}

/// Whether `path` begins with `part`, followed by nothing or by a dot.
bool begins_with(std::string_view path, std::string_view part) {
  return path.starts_with(part) && (path.size() == part.size() || path[part.size()] == '.');
}

/// One part of a path: where it leads, and how many characters of the path it takes.
struct PathPart {
  Json* to;
  std::size_t length;
};

PathPart into_list(Json& list, std::string_view rest, const std::string& path,
                   const std::string& place) {
  const std::string part(rest.substr(0, rest.find('.')));
  const bool is_index = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
  if (is_index && part.size() < 6 && std::stoul(part) < list.size())
    return {&list[std::stoul(part)], part.size()};
  for (auto& entry : list)
    for (const auto& name : names_of(entry))
      if (begins_with(rest, name)) {
        if (entry.is_string() && name.size() < rest.size()) entry = Json{{"filter", name}};
        return {&entry, name.size()};
      }
  throw InputError(place, fmt::format("'{}' in {} is not an index or a name in a list of {}", part,
                                      path, list.size()));
}

PathPart step_into(Json& json, std::string_view rest, const std::string& path,
                   const std::string& place) {
  if (json.is_array()) return into_list(json, rest, path, place);
  if (!json.is_object() && !json.is_null())
    throw InputError(place,
                     fmt::format("{} leads through {}, which has no parts", path, json.dump()));
  const std::string part(rest.substr(0, rest.find('.')));
  return {&json[part], part.size()};
}

}  // namespace

void set_at(Json& json, const std::string& path, const Json& value, const std::string& place) {
  Json* at = &json;
  std::string_view rest = path;
  for (;;) {
    const auto [to, length] = step_into(*at, rest, path, place);
    at = to;
    if (length >= rest.size()) break;
    rest.remove_prefix(length + 1);
  }
  *at = value;
}

std::string last_part(const std::string& path) { return path.substr(path.rfind('.') + 1); }

}  // namespace gyrostat
