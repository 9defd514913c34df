#pragma once

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

#include <gyrostat/diagnosis/cause_type.hpp>

namespace gyrostat::gap {

/// Which of an effect's fields has the name.
inline std::size_t field_of(const Effect& effect, std::string_view name) {
  const auto fields = effect.fields();
  return static_cast<std::size_t>(
      std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.name == name; }) -
      fields.begin());
}

/// The fields of an effect's amplitudes, of which one that is 0 belongs to another form of it.
inline std::vector<std::size_t> amplitudes_of(const Effect& effect, const CauseType& cause) {
  std::vector<std::size_t> all;
  for (std::size_t a = 0; a < cause.amplitudes; ++a)
    if (const auto field = field_of(effect, cause.free_parameters[a]); effect.value(field) != 0.0)
      all.push_back(field);
  return all;
}

/// Whether all axes of a sensor have a field of an effect alike.
inline bool is_alike(const Effect& effect, std::size_t field) {
  const auto& alike = cause_types().named(effect.id(), "effects").alike;
  return std::find(alike.begin(), alike.end(), effect.fields()[field].name) != alike.end();
}

/// The effect of a name with some values of its fields; defaults for the others.
inline Effect with_values(std::string_view id,
                          std::initializer_list<std::pair<std::string_view, double>> values) {
  Effect effect = cause_types().named(id, "effects").effect();
  for (const auto& [name, value] : values) effect.value(field_of(effect, name)) = value;
  return effect;
}

}  // namespace gyrostat::gap
