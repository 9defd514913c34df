#include <gyrostat/experiments/plugins/description.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/tests/fuzz/target.hpp>

namespace gyrostat::fuzz {
namespace {

/// As what a process says of its filters and effects at its start.
void read_plugin(const std::filesystem::path& path) {
  const auto place = path.string() + ":";
  const Json json = read_json(path.string());
  JsonObject object(json, place);
  for (const auto& [filter, at] : object.list("filters"))
    read_filter_description(object.at(*filter, at));
  for (const auto& [effect, at] : object.list("effects"))
    read_effect_description(object.at(*effect, at));
}

}  // namespace

Target target_plugin() {
  return {.file = "description.json",
          .seeds = {R"({"filters": [{"name": "mine", "title": "a mean", "corrects": "thermal_drift",
             "needs": ["temperature_C"], "parameters": [{"name": "gain", "unit": "1/s",
               "meaning": "of it", "above": 0, "to": 1, "default": 0.5}]}],
           "effects": [{"name": "hum", "stage": "electronics", "needs": ["temperature_C"],
             "parameters": [{"name": "amplitude_dps", "unit": "dps", "from": 0, "to": 9,
               "default": 1}], "absent": [0]}]})"},
          .read = read_plugin};
}

}  // namespace gyrostat::fuzz
