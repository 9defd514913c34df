#pragma once

#include <algorithm>
#include <deque>
#include <span>
#include <vector>

#include <gyrostat/core/chosen.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat {

/// A sensor effect without its C++ type.
struct EffectType : ParametricType {
  static constexpr std::string_view kind = "effect";

  Stage stage;
  std::span<std::vector<double> Series::*const> needs;  ///< channels
  void (*apply)(const std::any& effect, Series& series, const Noise& noise) = nullptr;

  static void describe_all(std::deque<EffectType>& to);
};

inline Registry<EffectType>& effect_types() { return Registry<EffectType>::all(); }

/// An effect with its parameters.
class Effect : public Chosen<EffectType> {
 public:
  using Chosen::Chosen;

  Stage stage() const { return type().stage; }
  /// Changes the series as the effect does, under the trial's noise.
  void apply(Series& series, const Noise& noise) const { type().apply(plugin(), series, noise); }
};

/// The description of an effect under a name. A program that describes and adds one of its own has
/// it in its scenarios:
///
///   gyrostat::effect_types().add(gyrostat::describe_effect<MyEffect>("mine"));
template <class E>
EffectType describe_effect(std::string_view id) {
  static constexpr auto needs = E::needs;
  return {describe_parametric<E>(id), E::stage, needs,
          [](const std::any& effect, Series& series, const Noise& noise) {
            std::any_cast<E>(&effect)->apply(series, noise);
          }};
}

}  // namespace gyrostat
