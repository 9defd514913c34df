#include <fmt/format.h>

#include <gyrostat/experiments/blind/blind_check.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/scenario_reading.hpp>

namespace gyrostat::gap {
namespace {

namespace fs = std::filesystem;

/// The default effect of that name with the parameters of `object`.
Effect read_effect(const std::string& name, const std::string& place, JsonObject object) {
  Effect effect(effect_types().named(name, place));
  object.fields(effect);
  object.finish();
  return effect;
}

std::vector<BlindCase> at_each_duration(const std::vector<BlindCase>& cases,
                                        const std::vector<double>& durations_s) {
  std::vector<BlindCase> all;
  for (const double duration_s : durations_s)
    for (BlindCase c : cases) {
      c.scenario.sampling.duration_s = duration_s;
      all.push_back(std::move(c));
    }
  return all;
}

}  // namespace

BlindCheck read_blind_check(const std::string& path) {
  const Json json = read_json(path);
  JsonObject object(json, path + ":");
  BlindCheck check;
  check.file = json;
  check.title = object.text("title", path);
  check.seed = static_cast<std::uint64_t>(object.number("seed", 1, ranges::count, ""));
  check.recordings = static_cast<std::uint32_t>(object.number("recordings", 10, ranges::count, ""));
  check.none_recordings =
      static_cast<std::uint32_t>(object.number("none_recordings", 40, ranges::count, ""));
  check.left_out = object.number("left_out", 1, ranges::flag, "") != 0.0;
  std::vector<double> durations_s;
  for (const auto& [value, place] : object.list("durations_s"))
    durations_s.push_back(JsonObject::checked_number(*value, place, ranges::positive, "s"));

  FittedRecordings fits;
  std::vector<std::pair<std::string, BlindCase>> bare;
  if (!object.has("scenarios")) throw InputError(path, "\"scenarios\" is missing");
  for (const auto& [name, value] : json.at("scenarios").items()) {
    const std::string place = fmt::format("{}: scenarios.{}", path, name);
    BlindCase c{
        .effects = {},
        .strength = "",
        .scenario = read_scenario({value, place}, fs::path(path).parent_path().string(), fits)};
    c.has_motion = value.contains("motion");
    bare.emplace_back(name, c);
    check.cases.push_back(c);
  }
  const auto scenario_named = [&](const std::string& name, const std::string& place) {
    std::vector<std::string> names;
    for (const auto& [known, c] : bare) {
      if (known == name) return c;
      names.push_back(known);
    }
    throw InputError(place, unknown_name("scenario", name, names));
  };
  for (const auto& [value, place] : object.list("cases")) {
    JsonObject entry(*value, place);
    const auto name = entry.required_text("effect");
    const auto base = scenario_named(entry.required_text("scenario"), entry.place_of("scenario"));
    const auto second = entry.text("and", "");
    std::optional<Effect> other;
    if (!second.empty())
      other = read_effect(second, entry.place_of("and"),
                          entry.child("and_with").value_or(JsonObject(Json::object(), place)));
    for (const std::string strength : {"strong", "medium", "weak"}) {
      auto parameters = entry.child(strength);
      if (!parameters) continue;
      BlindCase c = base;
      c.effects = {name};
      c.strength = strength;
      c.scenario.effects.push_back(read_effect(name, entry.place_of("effect"), *parameters));
      if (other) {
        c.effects.push_back(second);
        c.scenario.effects.push_back(*other);
      }
      check.cases.push_back(std::move(c));
    }
    entry.finish();
    if (!value->contains("strong") && !value->contains("medium") && !value->contains("weak"))
      throw InputError(
          place,
          "\"strong\", \"medium\" or \"weak\" is needed, an object of the effect's parameters");
  }
  object.finish();
  if (!durations_s.empty()) check.cases = at_each_duration(check.cases, durations_s);
  return check;
}

}  // namespace gyrostat::gap
