#include <gyrostat/experiments/study/method.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat {
namespace {

constexpr std::array<std::pair<std::string_view, ParameterSource>, 3> sources = {{
    {"defaults", ParameterSource::defaults},
    {"calibration", ParameterSource::calibration},
    {"truth", ParameterSource::truth},
}};

ParameterSource source_of(const FilterType& filter, ParameterSource fallback) {
  return filter.role.is_bound() ? ParameterSource::truth : fallback;
}

ParameterMap read_overrides(JsonObject object, const FilterType& filter) {
  ParameterMap given;
  for (const auto& field : filter.fields) {
    const std::string name(field.name);
    const double value = object.number(name, field.value, field.range, field.unit);
    if (object.has(name)) given[name] = value;
  }
  object.finish();
  return given;
}

/// {"parameter": [low, high]} within the parameter's own range.
std::map<std::string, SearchRange> read_tune(JsonObject object, const FilterType& filter) {
  std::map<std::string, SearchRange> tune;
  for (const auto& field : filter.fields) {
    const std::string name(field.name);
    const auto bounds = object.list(name);
    if (bounds.empty()) continue;
    const auto bound = [&](std::size_t i) {
      return JsonObject::checked_number(*bounds[i].first, bounds[i].second, field.range,
                                        field.unit);
    };
    object.attempt([&] {
      if (bounds.size() != 2)
        throw InputError(object.place_of(name), "two bounds [low, high] are needed here");
      tune[name] = {bound(0), bound(1), field.range.whole};
      if (!(tune[name].low < tune[name].high))
        throw InputError(object.place_of(name), "the lower bound is not below the upper");
    });
  }
  object.finish();
  return tune;
}

std::string method_id(const std::string& name, const std::string& place) {
  auto id = plain_name(name, place);
  if (id.find_first_of(",:") != std::string::npos)
    throw InputError(place,
                     "'" + id + "' cannot head a column or end an address: no commas, no colons");
  return id;
}

/// A method by its filter's name alone, or as an `object`.
Method read_method(const JsonObject& parent, const Json& value, const std::string& place,
                   ParameterSource fallback) {
  Method method;
  if (value.is_string()) {
    method.filter = method.id = value.get<std::string>();
    method.source = source_of(method.type(place), fallback);
    return method;
  }
  JsonObject object = parent.at(value, place);
  const auto id = object.text("id", "");
  method.filter = object.has("filter") || id.empty() ? object.required_text("filter") : id;
  const auto& filter = method.type(object.place_of("filter"));
  method.id = object.named("id", method.filter, method_id);
  method.source = source_of(filter, fallback);
  if (object.has("parameters_from") && fallback == ParameterSource::defaults)
    object.complain(object.place_of("parameters_from"),
                    "'" + object.text("parameters_from", "") +
                        "' is not to be had here; give the parameters themselves");
  else if (object.has("parameters_from"))
    method.source = object.named("parameters_from", "truth", parameter_source_named);
  object.with_child("parameters", [&](JsonObject& parameters) {
    method.overrides = read_overrides(parameters, filter);
  });
  object.with_child("tune", [&](JsonObject& tune) { method.tune = read_tune(tune, filter); });
  object.finish();
  return method;
}

}  // namespace

std::string plain_name(std::string name, const std::string& place) {
  const auto unfit = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '"'; };
  if (name.empty()) throw InputError(place, "the name is empty");
  if (std::any_of(name.begin(), name.end(), unfit))
    throw InputError(place, Json(name).dump() + " is no name: no quotes or line breaks");
  if (std::string_view("=+-@").find(name.front()) != std::string_view::npos)
    throw InputError(place, Json(name).dump() +
                                " is no name: a spreadsheet takes what begins with "
                                "=, +, - or @ for a formula");
  return name;
}

std::vector<Method> read_methods(JsonObject& object, const std::string& key,
                                 ParameterSource default_source) {
  std::vector<Method> methods;
  for (const auto& entry : object.list(key)) {
    object.attempt([&] {
      methods.push_back(read_method(object, *entry.first, entry.second, default_source));
      for (std::size_t i = 0; i + 1 < methods.size(); ++i)
        if (methods[i].id == methods.back().id)
          throw InputError(entry.second,
                           "the id '" + methods.back().id + "' stands twice; give one an \"id\"");
    });
  }
  return methods;
}

ParameterSource parameter_source_named(const std::string& name, const std::string& place) {
  std::vector<std::string> names;
  for (const auto& [known, source] : sources) {
    if (known == name) return source;
    names.emplace_back(known);
  }
  throw InputError(place, unknown_name("source of parameters", name, names));
}

std::vector<Method> all_methods(ParameterSource source) {
  std::vector<Method> methods;
  for (const auto& filter : filter_types()) {
    const std::string id(filter.id);
    if (!filter.draws_noise) methods.push_back({id, id, source_of(filter, source), {}, {}});
  }
  // What every other row is read against stands at the top and at the bottom.
  std::stable_partition(methods.begin(), methods.end(),
                        [](const auto& m) { return m.role().is_floor(); });
  std::stable_partition(methods.begin(), methods.end(),
                        [](const auto& m) { return !m.role().is_bound(); });
  return methods;
}

}  // namespace gyrostat
