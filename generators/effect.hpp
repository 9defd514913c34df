#pragma once

#include <algorithm>
#include <concepts>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include <gyrostat/core/chosen.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat {

/// A sensor effect without its C++ type.
struct EffectType : ParametricType {
  static constexpr std::string_view kind = "effect";

  Stage stage;                                          ///< unless `acts_at` says otherwise
  std::span<std::vector<double> Series::*const> needs;  ///< channels
  void (*apply)(const std::any& effect, Series& series, const Noise& noise) = nullptr;
  /// Whether it changes each sample of the gyro by the channels of that sample alone, without
  /// noise: then it may be given any samples, also those of several trials, in any order. Null: it
  /// does not.
  bool (*is_sample_by_sample)(const std::any& effect) = nullptr;
  /// Null: at `stage`, whatever its parameters.
  Stage (*acts_at)(const std::any& effect) = nullptr;
  /// Null: none.
  Response (*response)(const std::any& effect) = nullptr;
  /// Tells its code from another under the same name; empty for code of the program itself.
  std::string code{};

  static void describe_all(std::deque<EffectType>& to);
};

inline Registry<EffectType>& effect_types() { return Registry<EffectType>::all(); }

/// An effect with its parameters.
///
/// Example: an effect by its type, and the same by its name.
///
///   #include <gyrostat/generators/effects/quantization.hpp>
///
///   const Effect known = effects::Quantization{.lsb_dps = 0.01};
///   Effect named(effect_types().named("quantization", "example"));
///   named.value(0) = 0.01;
class Effect : public Chosen<EffectType> {
 public:
  using Chosen::Chosen;

  Stage stage() const {
    return type().acts_at != nullptr ? type().acts_at(plugin()) : type().stage;
  }
  bool is_sample_by_sample() const {
    return type().is_sample_by_sample != nullptr && type().is_sample_by_sample(plugin());
  }
  Response response() const {
    return type().response != nullptr ? type().response(plugin()) : Response::none;
  }
  bool is_response() const { return response() != Response::none; }
  /// Changes the series as the effect does, under the trial's noise.
  void apply(Series& series, const Noise& noise) const { type().apply(plugin(), series, noise); }
};

/// An effect says so by a static `sample_by_sample`, and by `is_sample_by_sample` where it depends
/// on its parameters.
template <class E>
bool acts_sample_by_sample(const std::any& effect) {
  if constexpr (requires(const E& e) { e.is_sample_by_sample(); })
    return std::any_cast<E>(&effect)->is_sample_by_sample();
  return requires { E::sample_by_sample; };
}

/// An effect whose stage depends on its parameters has an `acts_at`.
template <class E>
Stage stage_of(const std::any& effect) {
  if constexpr (requires(const E& e) { e.acts_at(); }) return std::any_cast<E>(&effect)->acts_at();
  return E::stage;
}

/// An effect that may say how the rate is sensed has a `response`.
template <class E>
concept MayRespond = requires(const E& effect) {
  { effect.response() } -> std::same_as<Response>;
};

template <class E>
Response response_of(const std::any& effect) {
  if constexpr (MayRespond<E>) return std::any_cast<E>(&effect)->response();
  return Response::none;
}

/// The description of an effect under a name. A program that describes and adds one of its own has
/// it in its scenarios, beside those of gyrostat.
///
/// Example: a gyro whose sign is turned for a while.
///
///   #include <gyrostat/generators/sampled.hpp>
///
///   struct Turned {
///     double until_s = 0.0;
///
///     static constexpr std::string_view title = "the sign is turned";
///     static constexpr Stage stage = Stage::transport;
///     static constexpr std::array needs = {&Series::gyro_dps};
///
///     static constexpr auto fields() {
///       using P = Turned;
///       return std::array{Field{"until_s", &P::until_s, "s", ranges::non_negative, "its end"}};
///     }
///     static constexpr Turned absent() { return {}; }
///
///     void apply(Series& series, const Noise& /*noise*/) const {
///       for (std::size_t i = 0; i < series.size() && series.t_s[i] < until_s; ++i)
///         series.gyro_dps[i] = -series.gyro_dps[i];
///     }
///   };
///
///   effect_types().add(describe_effect<Turned>("turned"));
///
/// Thread safety: `add` is for the start of a program (Registry). `apply` is called from many
/// threads at once, each with a series of its own, so an effect has no state but its parameters.
template <class E>
EffectType describe_effect(std::string_view id) {
  static constexpr auto needs = E::needs;
  return {describe_parametric<E>(id),
          E::stage,
          needs,
          [](const std::any& effect, Series& series, const Noise& noise) {
            std::any_cast<E>(&effect)->apply(series, noise);
          },
          acts_sample_by_sample<E>,
          stage_of<E>,
          response_of<E>};
}

}  // namespace gyrostat
