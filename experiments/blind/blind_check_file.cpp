#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/experiments/blind/blind_check.hpp>
#include <gyrostat/experiments/blind/blind_labels.hpp>
#include <gyrostat/experiments/blind/near_forms.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/scenario_reading.hpp>
#include <gyrostat/recordings/recording.hpp>

namespace gyrostat::gap {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> strengths = {"strong", "medium", "weak"};
constexpr Range any_count{.from = 0, .whole = true};

/// With the parameters of `object`.
Effect read_effect(const EffectType& type, JsonObject object) {
  Effect effect(type);
  object.fields(effect);
  object.finish();
  return effect;
}

std::string text_of(const Json& value, const std::string& place) {
  if (!value.is_string()) throw InputError(place, fmt::format("{} is not a text", value.dump()));
  return value.get<std::string>();
}

std::vector<std::string> read_texts(JsonObject& object, const std::string& key) {
  std::vector<std::string> texts;
  for (const auto& [value, place] : object.list(key)) texts.push_back(text_of(*value, place));
  return texts;
}

/// The list of effects under `key`.
std::vector<std::string> read_names(JsonObject& object, const std::string& key) {
  std::vector<std::string> names;
  for (const auto& [value, place] : object.list(key))
    names.emplace_back(effect_types().named(text_of(*value, place), place).id);
  return names;
}

/// The recordings at rest of which a scenario makes its noise; its sampling is theirs.
void read_noise(JsonObject object, const fs::path& folder, BlindCase& into) {
  const auto files = folder / object.text("folder", "");
  auto axes = read_texts(object, "axes");
  if (axes.empty()) axes = {""};
  const double longest_s = object.number("duration_s", 1e7, ranges::positive, "s");
  into.noise_step_dps = object.number("rounded_to_dps", 0.0, ranges::non_negative, "dps");
  double rate_hz = 0.0;
  for (const auto& [value, place] : object.list("files")) {
    const auto name = text_of(*value, place);
    for (const auto& axis : axes) {
      const auto path = (files / name).lexically_normal().string();
      const auto read = read_recording(path, axis);
      require_uniform(read.series, path, read.first_row);
      const auto& gyro = read.series.gyro_dps;
      if (std::any_of(gyro.begin(), gyro.end(), [](double z) { return z != z; }))
        throw InputError(place, "the recording has missing values; noise must be without gaps");
      if (rate_hz == 0.0) rate_hz = read.series.rate_hz();
      if (std::abs(read.series.rate_hz() / rate_hz - 1.0) > 1e-3)
        throw InputError(
            place, fmt::format("{:g} Hz is another rate than the {:g} Hz of the files before it",
                               read.series.rate_hz(), rate_hz));
      into.noises.push_back({axis.empty() ? name : name + " " + axis,
                             std::make_shared<const std::vector<double>>(gyro)});
    }
  }
  object.finish();
  if (into.noises.empty())
    throw InputError(object.place(), "\"files\" is missing, a list of recordings");
  std::size_t shortest = into.noises.front().dps->size();
  for (const auto& noise : into.noises) shortest = std::min(shortest, noise.dps->size());
  into.scenario.sampling = {std::min(longest_s, static_cast<double>(shortest) / rate_hz), rate_hz};
}

/// A scenario as a study has it, and besides: `noise`, `own`, `without`.
BlindCase read_bare_case(const std::string& name, const Json& value, const std::string& place,
                         const fs::path& folder, FittedRecordings& fits) {
  JsonObject object(value, place);
  BlindCase c;
  c.scenario_name = name;
  c.own = read_names(object, "own");
  c.without = read_names(object, "without");
  Json plain = value;
  for (const auto* key : {"noise", "own", "without"}) plain.erase(key);
  c.scenario = read_scenario({plain, place}, folder.string(), fits);
  for (const auto& effect : c.scenario.effects) c.own.emplace_back(effect.id());
  c.has_motion = value.contains("motion");
  if (auto noise = object.child("noise")) {
    for (const auto* key : {"duration_s", "rate_hz", "random_error"})
      if (value.contains(key))
        throw InputError(object.place_of(key), "recorded noise has its own; leave it out");
    c.has_temperature = value.contains("temperature");
    c.has_compass = value.contains("compass");
    read_noise(*noise, folder, c);
  }
  return c;
}

/// Lengths and rates at which everything is recorded; none: those of the scenarios.
struct Samplings {
  std::vector<double> durations_s;
  std::vector<Sampling> samplings;

  explicit Samplings(JsonObject& object) {
    for (const auto& [value, place] : object.list("durations_s"))
      durations_s.push_back(JsonObject::checked_number(*value, place, ranges::positive, "s"));
    for (const auto& [value, place] : object.list("samplings")) {
      auto entry = object.at(*value, place);
      entry.fields(samplings.emplace_back());
      entry.finish();
    }
  }

  std::vector<BlindCase> of(const BlindCase& c, const std::string& place) const {
    std::vector<Sampling> all = samplings;
    for (const double duration_s : durations_s)
      all.push_back({duration_s, c.scenario.sampling.rate_hz});
    if (all.empty()) return {c};
    std::vector<BlindCase> cases;
    for (const auto& sampling : all) {
      const auto& own = c.scenario.sampling;
      if (!c.noises.empty() &&
          (sampling.rate_hz != own.rate_hz || sampling.duration_s > own.duration_s))
        throw InputError(
            place, fmt::format("{:g} s at {:g} Hz is not in its noise, which has {:g} "
                               "s at {:g} Hz",
                               sampling.duration_s, sampling.rate_hz, own.duration_s, own.rate_hz));
      cases.push_back(c);
      cases.back().scenario.sampling = sampling;
    }
    return cases;
  }
};

void put_in(BlindCase& c, const Effect& effect, const std::string& name) {
  c.effects.push_back(name);
  c.scenario.effects.push_back(effect);
}

/// An entry of "cases", at each of its strengths.
std::vector<BlindCase> read_case(JsonObject entry, const BlindCase& base, bool left_out) {
  const auto& place = entry.place();
  const auto name = entry.required_text("effect");
  const auto* type = &effect_types().named(name, entry.place_of("effect"));
  if (holds(base.own, name))
    throw InputError(entry.place_of("effect"),
                     fmt::format("scenario '{}' has a {} of its own; it would not be scored",
                                 base.scenario_name, name));
  BlindCase near = base;
  if (const auto form = entry.text("form", ""); !form.empty()) {
    const auto& found = near_form(form, name, entry.place_of("form"));
    type = &found.type;
    near.form = form;
    for (const auto& other : found.names)
      if (other != name) near.own.push_back(other);
  }
  near.form = entry.text("as", near.form);
  std::optional<Effect> other;
  if (const auto second = entry.text("and", ""); !second.empty())
    other = read_effect(effect_types().named(second, entry.place_of("and")),
                        entry.child("and_with").value_or(JsonObject(Json::object(), place)));
  std::vector<BlindCase> cases;
  for (const auto& strength : strengths) {
    auto parameters = entry.child(strength);
    if (!parameters) continue;
    auto& c = cases.emplace_back(near);
    c.strength = strength;
    put_in(c, read_effect(*type, *parameters), name);
    if (other) put_in(c, *other, std::string(other->id()));
    if (left_out && !other && strength == "strong") c.left_out = name;
  }
  entry.finish();
  if (cases.empty())
    throw InputError(
        place,
        "\"strong\", \"medium\" or \"weak\" is needed, an object of the effect's parameters");
  return cases;
}

/// An entry of "sets".
BlindSets read_sets(JsonObject entry, const BlindCase& base) {
  BlindSets sets;
  sets.base = base;
  for (const auto& [value, place] : entry.list("sizes"))
    sets.sizes.push_back(static_cast<std::size_t>(JsonObject::checked_number(
        *value, place, Range{.from = 2, .to = 10, .whole = true}, "effects")));
  if (sets.sizes.empty()) sets.sizes = {2, 3, 4, 5};
  auto known = strengths;
  known.emplace_back("mixed");
  for (const auto& [value, place] : entry.list("strengths")) {
    sets.strengths.push_back(text_of(*value, place));
    if (!holds(known, sets.strengths.back()))
      throw InputError(place, unknown_name("strength", sets.strengths.back(), known));
  }
  if (sets.strengths.empty()) sets.strengths = {"strong", "medium", "mixed"};
  sets.recordings = static_cast<std::uint32_t>(entry.number("recordings", 0, ranges::count, ""));
  sets.left_out = entry.number("left_out", 0, ranges::flag, "") != 0.0;
  entry.finish();
  return sets;
}

}  // namespace

BlindCheck read_blind_check(const std::string& path) {
  const Json json = read_json(path);
  JsonObject object(json, path + ":");
  BlindCheck check;
  check.file = json;
  check.title = object.text("title", path);
  check.seed = static_cast<std::uint64_t>(object.number("seed", 1, ranges::count, ""));
  check.recordings = static_cast<std::uint32_t>(object.number("recordings", 10, any_count, ""));
  check.none_recordings =
      static_cast<std::uint32_t>(object.number("none_recordings", 40, any_count, ""));
  const bool left_out = object.number("left_out", 1, ranges::flag, "") != 0.0;
  const Samplings samplings(object);

  FittedRecordings fits;
  std::vector<BlindCase> bare;
  if (!object.has("scenarios")) throw InputError(path, "\"scenarios\" is missing");
  for (const auto& [name, value] : json.at("scenarios").items()) {
    const auto place = fmt::format("{}: scenarios.{}", path, name);
    bare.push_back(read_bare_case(name, value, place, fs::path(path).parent_path(), fits));
    for (auto& c : samplings.of(bare.back(), place)) check.cases.push_back(std::move(c));
  }
  const auto base_of = [&](JsonObject& entry) {
    const auto name = entry.required_text("scenario");
    std::vector<std::string> names;
    for (const auto& c : bare) {
      if (c.scenario_name == name) return c;
      names.push_back(c.scenario_name);
    }
    throw InputError(entry.place_of("scenario"), unknown_name("scenario", name, names));
  };
  for (const auto& [value, place] : object.list("cases")) {
    auto entry = object.at(*value, place);
    const auto base = base_of(entry);
    for (const auto& c : read_case(entry, base, left_out))
      for (auto& sampled : samplings.of(c, place)) check.cases.push_back(std::move(sampled));
  }
  for (const auto& [value, place] : object.list("sets")) {
    auto entry = object.at(*value, place);
    const auto sets = read_sets(entry, base_of(entry));
    for (auto& sampled : samplings.of(sets.base, place)) {
      check.sets.push_back(sets);
      check.sets.back().base = std::move(sampled);
    }
  }
  for (const auto& [value, place] : object.list("never_together")) {
    const Json wrapped = {{"effects", *value}};
    JsonObject group(wrapped, place);
    check.never_together.push_back(read_names(group, "effects"));
  }
  object.finish();
  return check;
}

}  // namespace gyrostat::gap
