#include "experiments/cell_parameters.hpp"

#include <algorithm>

#include "core/filters/list.hpp"

namespace gyrostat {
namespace {

using Parameters = std::vector<CellParameter>;

template <class P>
void add(Parameters& list, const std::string& prefix, const P& p) {
  for (const auto& field : P::fields())
    list.push_back({fmt::format("{}.{}", prefix, field.name), p.*(field.member),
                    std::string(field.unit), field.range});
}

template <class Any>
void add_any(Parameters& list, const std::string& prefix, const Any& any) {
  std::visit(
      [&](const auto& chosen) {
        if constexpr (requires { chosen.fields(); }) add(list, prefix, chosen);
      },
      any);
}

void add_method(Parameters& list, const std::string& prefix, const Method& method,
                const ParameterMap& told) {
  Filters::with(method.id, "filter", method.filter, [&](auto plugin) {
    typename decltype(plugin)::type::Parameters p;
    set_parameters(p, method.overrides);
    const std::size_t first = list.size();
    add(list, prefix + ".parameters", p);
    for (std::size_t i = first; i < list.size(); ++i) {
      const auto name = list[i].path.substr(list[i].path.rfind('.') + 1);
      if (told.contains(name) && !method.overrides.contains(name)) list[i].value = no_value;
    }
  });
}

}  // namespace

Parameters cell_parameters(const Cell& cell) {
  Parameters list;
  const auto& s = cell.scenario;
  add(list, "scenario", s.sampling);
  add(list, "scenario.random_error", s.random_error);
  add(list, "scenario.thermal_drift", s.thermal_drift);
  add_any(list, "scenario.temperature", s.temperature);
  add_any(list, "scenario.motion", s.motion);
  if (s.acceleration) add_any(list, "scenario.acceleration", *s.acceleration);
  add(list, "scenario.compass", s.compass);
  for (std::size_t i = 0; i < s.compass.disturbances.size(); ++i)
    add(list, fmt::format("scenario.compass.disturbances.{}", i), s.compass.disturbances[i]);
  for (std::size_t i = 0; i < s.effects.size(); ++i) {
    add_any(list, fmt::format("scenario.effects.{}", i), s.effects[i]);
    add_any(list, fmt::format("scenario.effects.{}", Effects::id_of(s.effects[i])), s.effects[i]);
  }
  Calibration calibration;
  calibration.thermal.emplace();
  const auto told = parameters_from(calibration, no_value);
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    const auto& method = cell.methods[m];
    const auto source = method.source == ParameterSource::defaults ? ParameterMap{} : told;
    add_method(list, fmt::format("filters.{}", m), method, source);
    add_method(list, "filters." + method.id, method, source);
  }
  return list;
}

CellParameter parameter_at(const Cell& cell, const std::string& path, const std::string& place) {
  const auto list = cell_parameters(cell);
  std::vector<std::string> paths;
  for (const auto& parameter : list) {
    if (parameter.path == path) return parameter;
    paths.push_back(parameter.path);
  }
  throw InputError(place, unknown_name("parameter", path, paths));
}

}  // namespace gyrostat
