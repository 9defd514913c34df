#pragma once

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <utility>

#include <gyrostat/diagnosis/cause_type.hpp>

namespace gyrostat::gap {

/// Which of an effect's fields has the name.
inline std::size_t field_of(const Effect& effect, std::string_view name) {
  const auto fields = effect.fields();
  return static_cast<std::size_t>(
      std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.name == name; }) -
      fields.begin());
}

/// The effect of a name with some values of its fields; defaults for the others.
inline Effect with_values(std::string_view id,
                          std::initializer_list<std::pair<std::string_view, double>> values) {
  Effect effect = cause_types().named(id, "effects").effect();
  for (const auto& [name, value] : values) effect.value(field_of(effect, name)) = value;
  return effect;
}

}  // namespace gyrostat::gap
