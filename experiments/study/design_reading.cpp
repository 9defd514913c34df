#include <array>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/experiments/study/cell_parameters.hpp>
#include <gyrostat/experiments/study/design.hpp>
#include <gyrostat/experiments/study/design_points.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/study_ranges.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t most_points = 1000000;

DesignKind read_kind(JsonObject& object) {
  std::vector<std::string> names;
  for (const auto kind : all_design_kinds) names.push_back(name_of(kind));
  const auto name = object.required_text("kind", names);
  for (const auto kind : all_design_kinds)
    if (name_of(kind) == name) return kind;
  throw InputError(object.place_of("kind"), unknown_name("design", name, names));
}

std::string shown(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// As much of each path's end as tells it from the others.
void name_parameters(std::vector<DesignParameter>& parameters) {
  for (auto& p : parameters) {
    std::size_t from = p.path.size();
    bool unique = false;
    while (!unique && from != 0) {
      const auto dot = p.path.rfind('.', from - 1);
      from = dot == std::string::npos ? 0 : dot;
      p.name = p.path.substr(from == 0 ? 0 : from + 1);
      unique = std::none_of(parameters.begin(), parameters.end(), [&](const auto& other) {
        return other.path != p.path && ("." + other.path).ends_with("." + p.name);
      });
      if (dot == std::string::npos) break;
    }
  }
}

std::string named_values(const Design& design, const std::vector<Json>& values) {
  std::string label;
  for (std::size_t p = 0; p < values.size(); ++p)
    if (!values[p].is_null())
      label += (label.empty() ? "" : ",") + design.parameters[p].name + "=" + shown(values[p]);
  return label;
}

/// An end of a parameter's span: as given, or that of the parameter's own range.
double end_of(JsonObject& object, const std::string& key, const DesignParameter& p, double own,
              bool is_open) {
  if (!object.has(key) && (is_open || !std::isfinite(own)))
    throw InputError(object.place(),
                     fmt::format("\"{}\" is missing, and the parameter's own range {} "
                                 "does not end there in a value",
                                 key, values_in_words(p.range, p.unit)));
  return object.number(key, own, p.range, p.unit);
}

void read_span(JsonObject& object, DesignParameter& p) {
  const bool starts =
      object.attempt([&] { p.from = end_of(object, "from", p, p.range.from, p.range.open_from); });
  const bool ends =
      object.attempt([&] { p.to = end_of(object, "to", p, p.range.to, p.range.open_to); });
  if (starts && ends && !(p.from < p.to))
    object.complain(object.place(), fmt::format("\"from\" {} is not below \"to\" {}",
                                                short_number(p.from), short_number(p.to)));
  const auto scale = object.text("scale", "linear");
  const std::array<std::string, 2> scales = {"linear", "log"};
  if (scale != scales[0] && scale != scales[1])
    object.complain(object.place_of("scale"), unknown_name("scale", scale, scales));
  p.logarithmic = scale == "log";
  if (p.logarithmic && starts && p.from <= 0.0)
    object.complain(object.place_of("from"),
                    fmt::format("{} {} has no logarithm; allowed with \"scale\": \"log\": (0, inf)",
                                short_number(p.from), p.unit));
}

void add_point(Design& design, const std::vector<Json>& values) {
  design.labels.push_back(named_values(design, values));
  auto& texts = design.values.emplace_back();
  for (const auto& value : values) texts.push_back(value.is_null() ? "" : value.dump());
}

/// One combination of all values after the other, the last parameter's changing fastest.
void combine(Design& design, const std::vector<std::vector<Json>>& values) {
  std::vector<std::vector<Json>> points = {{}};
  for (const auto& of_one : values) {
    std::vector<std::vector<Json>> next;
    for (const auto& point : points)
      for (const auto& value : of_one) {
        next.push_back(point);
        next.back().push_back(value);
      }
    points = std::move(next);
  }
  for (const auto& point : points) add_point(design, point);
}

std::vector<Json> listed(const Json& values, const std::string& place) {
  if (!values.is_array() || values.empty())
    throw InputError(place, "a list of values [...] is needed here");
  return {values.begin(), values.end()};
}

/// Values of a grid's parameter: listed, or "levels" of them from "from" to "to" where there is a
/// cell to know the parameter from.
std::vector<Json> grid_values(const Json& spec, const std::string& place, const Cell* base,
                              DesignParameter& p, Mistakes* mistakes) {
  if (!spec.is_object() || base == nullptr) return listed(spec, place);
  const auto known = parameter_at(*base, p.path, place);
  p.unit = known.unit;
  p.range = known.range;
  JsonObject object(spec, place, mistakes);
  read_span(object, p);
  const double levels = object.number("levels", 5, study_ranges::levels, "levels");
  object.finish();
  std::vector<Json> values;
  for (double l = 0; l < levels; ++l) values.emplace_back(p.at(l / (levels - 1.0)));
  return values;
}

void read_list(JsonObject& object, Design& design) {
  std::vector<std::vector<Json>> points;
  for (const auto& [point, place] : object.list("points")) {
    if (!point->is_object() || point->empty())
      throw InputError(place, "an object {\"path\": value, ...} is needed here");
    points.emplace_back(design.parameters.size());
    for (const auto& [path, value] : point->items()) {
      auto found = std::find_if(design.parameters.begin(), design.parameters.end(),
                                [&](const auto& p) { return p.path == path; });
      if (found == design.parameters.end()) {
        design.parameters.push_back({.path = path});
        for (auto& values : points) values.emplace_back();
        found = design.parameters.end() - 1;
      }
      points.back()[static_cast<std::size_t>(found - design.parameters.begin())] = value;
    }
  }
  if (points.empty())
    throw InputError(object.place_of("points"), "a list of points is needed here");
  name_parameters(design.parameters);
  for (const auto& values : points) add_point(design, values);
}

void read_parameter(const std::string& path, JsonObject span, const Cell& cell, Design& design) {
  const auto known = parameter_at(cell, path, span.place());
  auto& p = design.parameters.emplace_back(
      DesignParameter{.path = path, .unit = known.unit, .range = known.range});
  read_span(span, p);
  if (design.kind == DesignKind::one_at_a_time) {
    design.base.push_back(span.number("base", known.value, p.range, p.unit));
    if (std::isnan(design.base.back()))
      span.complain(span.place(), "\"base\" is missing: the value comes from a calibration");
    if (p.logarithmic && design.base.back() <= 0.0)
      span.complain(span.place(),
                    fmt::format("the base {} has no logarithm", short_number(design.base.back())));
  }
  span.finish();
}

/// Spans of the parameters, and where they have a "base" that; whether there was no mistake in
/// them.
bool read_spans(const JsonObject& object, const Json& parameters, const Cell& cell,
                Design& design) {
  bool sound = true;
  for (const auto& [path, spec] : parameters.items())
    sound = object.attempt([&] {
      read_parameter(path, object.at(spec, object.place_of("parameters") + "." + path), cell,
                     design);
    }) && sound;
  name_parameters(design.parameters);
  return sound;
}

void require_size(std::size_t points, const std::string& place) {
  if (points > most_points)
    throw InputError(place, fmt::format("{} points; allowed: up to {}", points, most_points));
}

/// How many points of which kind; whether there was no mistake in it.
struct PointCount {
  std::size_t points = 0;  ///< or trajectories, or rows
  bool sound = true;
};

PointCount read_count(JsonObject& object, Design& design) {
  PointCount count;
  const auto read = [&](const char* key, double fallback, std::size_t points_each) {
    count.sound = object.attempt([&] {
      count.points =
          static_cast<std::size_t>(object.number(key, fallback, study_ranges::points, key));
      require_size(count.points * points_each, object.place());
    });
  };
  const std::size_t parameters = design.parameters.size();
  switch (design.kind) {
    case DesignKind::latin_hypercube:
      read("points", 100, 1);
      break;
    case DesignKind::sobol:
      read("points", 128, 1);
      break;
    case DesignKind::one_at_a_time:
      break;
    case DesignKind::morris:
      read("trajectories", 20, parameters + 1);
      design.levels =
          static_cast<std::size_t>(object.number("levels", 4, study_ranges::levels, "levels"));
      if (design.levels % 2 != 0)
        object.complain(object.place_of("levels"),
                        fmt::format("{} is odd; allowed: even numbers", design.levels));
      count.sound = count.sound && design.levels % 2 == 0;
      break;
    case DesignKind::surrogate:
      read("rows", 32, parameters + 2);
      break;
    default:
      read("rows", 128, parameters + 2);
  }
  return count;
}

std::string design_name(const Json& cell, const std::string& place) {
  return JsonObject(cell, place).text("name", "cell");
}

void read_grid_parameters(const Json& grid, const std::string& place, const Cell* base,
                          Design& design, Mistakes* mistakes) {
  if (!grid.is_object()) throw InputError(place, "an object {\"path\": [values]} is needed here");
  for (const auto& [path, unused] : grid.items()) design.parameters.push_back({.path = path});
  name_parameters(design.parameters);
  std::vector<std::vector<Json>> values;
  const JsonObject object(grid, place, mistakes);
  for (auto& p : design.parameters)
    object.attempt([&] {
      values.push_back(grid_values(grid.at(p.path), place + "." + p.path, base, p, mistakes));
    });
  if (values.size() == design.parameters.size()) combine(design, values);
}

}  // namespace

Design read_grid(const Json& cell, const std::string& place, Mistakes* mistakes) {
  Design design{.name = design_name(cell, place), .kind = DesignKind::grid};
  read_grid_parameters(cell.at("grid"), place + ".grid", nullptr, design, mistakes);
  return design;
}

Design read_design(const Json& cell, const Cell& base, std::uint64_t seed, const std::string& place,
                   Mistakes* mistakes) {
  Design design{.name = design_name(cell, place)};
  JsonObject object(cell.at("design"), place + ".design", mistakes);
  if (!object.attempt([&] { design.kind = read_kind(object); })) {
    for (const char* key : {"parameters", "points", "trajectories", "levels", "rows"})
      object.has(key);  // which of them belong here is not known
    object.finish();
    return design;
  }
  if (design.kind == DesignKind::list) {
    read_list(object, design);
  } else {
    if (!object.child("parameters") || cell.at("design").at("parameters").empty())
      throw InputError(object.place_of("parameters"),
                       "an object {\"path\": {\"from\": …, \"to\": …}} is needed here");
    const Json& parameters = cell.at("design").at("parameters");
    if (design.kind == DesignKind::grid) {
      read_grid_parameters(parameters, object.place_of("parameters"), &base, design, mistakes);
    } else {
      const bool sound = read_spans(object, parameters, base, design);
      const auto count = read_count(object, design);
      if (sound && count.sound) place_points(count.points, seed, design);
    }
  }
  object.finish();
  return design;
}

}  // namespace gyrostat
