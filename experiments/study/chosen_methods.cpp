#include <gyrostat/experiments/study/chosen_methods.hpp>

#include <algorithm>
#include <numeric>

#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat {

std::vector<std::size_t> chosen_methods(JsonObject& object, const std::string& key,
                                        const Cell& cell) {
  std::vector<std::string> ids;
  for (const auto& method : cell.methods) ids.push_back(method.id);
  std::vector<std::size_t> chosen(object.has(key) ? 0 : ids.size());
  std::iota(chosen.begin(), chosen.end(), 0U);
  for (const auto& [value, place] : object.list(key)) {
    const auto id = value->is_string() ? value->get<std::string>() : value->dump();
    const auto found = std::find(ids.begin(), ids.end(), id);
    if (found == ids.end()) throw InputError(place, unknown_name("method", id, ids));
    const auto index = static_cast<std::size_t>(found - ids.begin());
    if (std::find(chosen.begin(), chosen.end(), index) != chosen.end())
      throw InputError(object.place_of(key), "a method stands twice");
    chosen.push_back(index);
  }
  if (chosen.empty()) throw InputError(object.place_of(key), "the list is empty");
  return chosen;
}

}  // namespace gyrostat
