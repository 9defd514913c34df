#include <gyrostat/experiments/study/fleet_reading.hpp>

#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/scenario_reading.hpp>

namespace gyrostat {
namespace {

constexpr const char* what_a_fleet_is =
    "allowed: what `gyrostat diagnose A.csv B.csv ... --json FLEET.json` writes";

/// Standard errors by the widths of the intervals; NaN where there is none.
std::vector<double> errors_from(JsonObject found, const Effect& effect) {
  std::vector<double> errors(effect.fields().size(), no_value);
  found.with_child("intervals", [&](JsonObject& intervals) {
    for (std::size_t f = 0; f < errors.size(); ++f) {
      const std::string name(effect.fields()[f].name);
      const auto ends = intervals.list(name);
      if (ends.empty()) continue;
      if (ends.size() != 2)
        throw InputError(intervals.place_of(name), "two numbers [low, high] are needed here");
      const auto end = [&](std::size_t k) {
        return JsonObject::checked_number(*ends[k].first, ends[k].second, ranges::any,
                                          effect.fields()[f].unit);
      };
      errors[f] = (end(1) - end(0)) / (2.0 * normal_quantile(0.975));
    }
  });
  return errors;
}

FleetUnit read_unit(JsonObject each, FittedRecordings& fits) {
  for (const auto* other : {"axis", "part"})
    if (each.has(other))
      throw InputError(each.place(),
                       fmt::format("is {} of one sensor; a fleet is of several sensors",
                                   *other == 'a' ? "an axis" : "a part"));
  FleetUnit unit;
  unit.name = each.required_text("sensor");
  auto diagnosis = each.child("diagnosis");
  if (!diagnosis) throw InputError(each.place(), "\"diagnosis\" is missing");
  auto enriched = diagnosis->child("enriched");
  if (!enriched) throw InputError(diagnosis->place(), "\"enriched\" is missing");
  unit.scenario = read_scenario(*enriched, "", fits);
  const auto found = diagnosis->list("effects");
  std::set<std::string_view> seen;
  for (const auto& effect : unit.scenario.effects) {
    auto& errors = unit.errors.emplace_back();
    if (!seen.insert(effect.id()).second) continue;  // intervals are of the first of its kind
    for (const auto& [json, place] : found) {
      JsonObject one = diagnosis->at(*json, place);
      if (one.text("effect", "") == effect.id()) errors = errors_from(one, effect);
    }
  }
  return unit;
}

}  // namespace

std::shared_ptr<Fleet> read_fleet(const std::string& path, FittedRecordings& fits) {
  const Json json = read_json(path);
  JsonObject object(json, path + ":");
  if (object.has("verdict"))
    throw InputError(path, fmt::format("is the diagnosis of one recording; {}", what_a_fleet_is));
  if (!object.has("each")) throw InputError(path, fmt::format("is no fleet; {}", what_a_fleet_is));
  std::vector<FleetUnit> units;
  for (const auto& [each, place] : object.list("each"))
    units.push_back(read_unit(object.at(*each, place), fits));
  return std::make_shared<Fleet>(std::move(units), path);
}

}  // namespace gyrostat
