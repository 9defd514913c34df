#include <gyrostat/experiments/study/cell_parameters.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/experiments/study/fleet.hpp>

namespace gyrostat {
namespace {

using Parameters = std::vector<CellParameter>;

template <class P>
requires requires { P::fields(); }
void add(Parameters& list, const std::string& prefix, const P& p) {
  for (const auto& field : P::fields())
    list.push_back({fmt::format("{}.{}", prefix, field.name), p.*(field.member),
                    std::string(field.unit), field.range});
}

template <class Type>
void add(Parameters& list, const std::string& prefix, const Chosen<Type>& chosen) {
  for (std::size_t i = 0; i < chosen.fields().size(); ++i) {
    const auto& field = chosen.fields()[i];
    list.push_back({fmt::format("{}.{}", prefix, field.name), chosen.value(i),
                    std::string(field.unit), field.range});
  }
}

void add_method(Parameters& list, const std::string& prefix, const Method& method,
                const ParameterMap& told) {
  for (const auto& field : method.type().fields) {
    const auto given = method.overrides.find(field.name);
    const double value = given != method.overrides.end() ? given->second
                         : told.contains(field.name)     ? no_value
                                                         : field.value;
    list.push_back({fmt::format("{}.parameters.{}", prefix, field.name), value,
                    std::string(field.unit), field.range});
  }
}

}  // namespace

Parameters cell_parameters(const Cell& cell) {
  Parameters list;
  const auto& s = cell.scenario;
  add(list, "scenario", s.sampling);
  add(list, "scenario.random_error", s.random_error);
  add(list, "scenario.thermal_drift", s.thermal_drift);
  add(list, "scenario.temperature", s.temperature);
  add(list, "scenario.motion", s.motion);
  if (s.cross_motion_1) add(list, "scenario.cross_motion_1", *s.cross_motion_1);
  if (s.cross_motion_2) add(list, "scenario.cross_motion_2", *s.cross_motion_2);
  if (s.acceleration) add(list, "scenario.acceleration", *s.acceleration);
  add(list, "scenario.compass", s.compass);
  for (std::size_t i = 0; i < s.compass.disturbances.size(); ++i)
    add(list, fmt::format("scenario.compass.disturbances.{}", i), s.compass.disturbances[i]);
  const bool drawn = cell.fleet && cell.fleet->draws_effects();
  for (std::size_t i = 0; i < s.effects.size() && !drawn; ++i) {
    add(list, fmt::format("scenario.effects.{}", i), s.effects[i]);
    add(list, fmt::format("scenario.effects.{}", s.effects[i].id()), s.effects[i]);
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
