#include <gyrostat/experiments/plugins/description.hpp>

#include <array>
#include <utility>

#include <fmt/format.h>

#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t most_of_a_name = 60;

std::string checked_name(std::string name, const std::string& place) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const bool fits = !name.empty() && name.size() <= most_of_a_name && is_letter(name.front()) &&
                    std::all_of(name.begin(), name.end(), [&](char c) {
                      return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
                    });
  if (!fits)
    throw InputError(place, fmt::format("{} is no name; allowed: a letter, then letters, digits "
                                        "and _, {} at most",
                                        Json(name).dump(), most_of_a_name));
  return name;
}

std::string checked_line(std::string text, const std::string& place) {
  if (std::any_of(text.begin(), text.end(),
                  [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }))
    throw InputError(place, Json(text).dump() + " is not one line of text");
  return text;
}

std::string required_name(JsonObject& object, const std::string& key) {
  return checked_name(object.required_text(key), object.place_of(key));
}

std::string line(JsonObject& object, const std::string& key, const std::string& fallback) {
  return checked_line(object.text(key, fallback), object.place_of(key));
}

bool is_given(JsonObject& object, const std::string& key) { return object.has(key); }

/// "from" and "to" are allowed themselves, "above" and "below" are not.
Range read_range(JsonObject& object) {
  Range range;
  range.open_from = is_given(object, "above");
  range.open_to = is_given(object, "below");
  range.from = object.number(range.open_from ? "above" : "from", range.from, ranges::any, "");
  range.to = object.number(range.open_to ? "below" : "to", range.to, ranges::any, "");
  range.whole = object.number("whole", 0, ranges::flag, "") != 0.0;
  if (!(range.from < range.to))
    throw InputError(object.place(), fmt::format("its range {} is empty", range.to_string()));
  return range;
}

/// Name, unit and meaning go to `texts`, to which a field's views will point.
FieldInfo read_parameter(JsonObject object, std::vector<std::string>& texts) {
  texts.push_back(required_name(object, "name"));
  texts.push_back(line(object, "unit", "1"));
  texts.push_back(line(object, "meaning", ""));
  FieldInfo field;
  field.range = read_range(object);
  if (!is_given(object, "default")) throw InputError(object.place(), "\"default\" is missing");
  field.value = object.number("default", 0.0, field.range, texts[texts.size() - 2]);
  object.finish();
  return field;
}

void read_common(JsonObject& object, PluginDescription& to) {
  to.name = required_name(object, "name");
  to.title = line(object, "title", to.name);
  for (const auto& [parameter, place] : object.list("parameters"))
    to.fields.push_back(read_parameter(object.at(*parameter, place), to.texts));
  for (std::size_t i = 0; i < to.fields.size(); ++i) {
    to.fields[i].name = to.texts[3 * i];
    to.fields[i].unit = to.texts[3 * i + 1];
    to.fields[i].doc = to.texts[3 * i + 2];
    for (std::size_t k = 0; k < i; ++k)
      if (to.fields[k].name == to.fields[i].name)
        throw InputError(object.place_of("parameters"),
                         fmt::format("'{}' stands twice", to.fields[i].name));
  }
}

/// Which of `known` a text of the list is.
template <std::size_t N>
std::size_t which(const Json& value, const std::string& place, std::string_view kind,
                  const std::array<std::string_view, N>& known) {
  const auto text = value.is_string() ? value.get<std::string>() : value.dump();
  for (std::size_t i = 0; i < N; ++i)
    if (known[i] == text) return i;
  throw InputError(place,
                   unknown_name(kind, text, std::vector<std::string>(known.begin(), known.end())));
}

constexpr std::array<std::string_view, 7> stage_names = {
    "environment", "sensing", "noise", "electronics", "conversion", "transport", "compass"};

}  // namespace

std::vector<double> PluginDescription::defaults() const {
  std::vector<double> values;
  for (const auto& field : fields) values.push_back(field.value);
  return values;
}

std::vector<std::vector<double> Series::*> changed_at(Stage stage) {
  switch (stage) {
    case Stage::environment:
      return {&Series::temperature_C, &Series::rate_ref_dps};
    case Stage::sensing:
      return {&Series::thermal_bias_dps};
    case Stage::compass:
      return {&Series::heading_deg};
    default:
      return {&Series::gyro_dps};
  }
}

std::shared_ptr<const FilterDescription> read_filter_description(JsonObject object) {
  auto filter = std::make_shared<FilterDescription>();
  read_common(object, *filter);
  const auto corrects =
      which(object.text("corrects", "random_error"), object.place_of("corrects"), "goal",
            std::array<std::string_view, 2>{"random_error", "thermal_drift"});
  filter->role.corrects =
      corrects == 0 ? Role::Corrects::random_error : Role::Corrects::thermal_drift;
  const std::array<std::string_view, 3> channels_needed = {"temperature_C", "heading_deg", "truth"};
  for (const auto& [needed, place] : object.list("needs"))
    (std::array{&filter->needs.temperature, &filter->needs.heading,
                &filter->needs.truth})[which(*needed, place, "channel", channels_needed)][0] = true;
  if (filter->needs.truth) filter->role.rank = Role::Rank::bound;
  object.finish();
  return filter;
}

std::shared_ptr<const EffectDescription> read_effect_description(JsonObject object) {
  auto effect = std::make_shared<EffectDescription>();
  read_common(object, *effect);
  effect->stage = static_cast<Stage>(
      which(object.required_text("stage"), object.place_of("stage"), "stage", stage_names));
  std::array<std::string_view, channels.size()> known{};
  for (std::size_t i = 0; i < known.size(); ++i) known[i] = channels[i].name;
  for (const auto& [needed, place] : object.list("needs"))
    effect->needs.push_back(channels[which(*needed, place, "channel", known)].values);
  const auto absent = object.list("absent");
  if (absent.size() != effect->fields.size())
    throw InputError(object.place_of("absent"), fmt::format("{} values for {} parameters",
                                                            absent.size(), effect->fields.size()));
  for (std::size_t i = 0; i < absent.size(); ++i)
    effect->absent.push_back(JsonObject::checked_number(
        *absent[i].first, absent[i].second, effect->fields[i].range, effect->fields[i].unit));
  object.finish();
  return effect;
}

}  // namespace gyrostat
