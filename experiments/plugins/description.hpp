#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/experiments/study/json.hpp>
#include <gyrostat/generators/effect.hpp>

namespace gyrostat {

/// What a plug-in says of itself. The fields point into the texts, so it stays where it is.
struct PluginDescription {
  std::string name, title;
  std::vector<std::string> texts;
  std::vector<FieldInfo> fields;

  std::vector<double> defaults() const;
};

struct FilterDescription : PluginDescription {
  Needs needs;
  Role role;
};

struct EffectDescription : PluginDescription {
  Stage stage = Stage::electronics;
  std::vector<std::vector<double> Series::*> needs;
  std::vector<double> absent;  ///< values of the fields at which it changes no bit
};

/// The channels that effects of a stage may change.
std::vector<std::vector<double> Series::*> changed_at(Stage stage);

/// The descriptions of JSON that a process wrote (docs/plugins.md). Throw InputError with every
/// mistake in it.
std::shared_ptr<const FilterDescription> read_filter_description(JsonObject object);
std::shared_ptr<const EffectDescription> read_effect_description(JsonObject object);

}  // namespace gyrostat
