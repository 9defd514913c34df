#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <gyrostat/diagnosis/catalogue/sensor_bandwidth.hpp>
#include <gyrostat/diagnosis/likelihood/arima_law.hpp>
#include <gyrostat/diagnosis/likelihood/beside.hpp>
#include <gyrostat/diagnosis/likelihood/dials.hpp>
#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/generators/effects/time_offset.hpp>

namespace gyrostat::gap {
namespace {

/// Where of a filter and a shift one goes, the other as late as both were.
std::optional<Scenario> as_late_alone(const Effect& gone, Scenario rest) {
  using Filtered = Diagnosed<effects::SensorBandwidth>;
  for (auto& effect : rest.effects) {
    const auto* filter = gone.as<effects::SensorBandwidth>();
    const auto* shift = gone.as<effects::TimeOffset>();
    if (const auto* stays = effect.as<effects::TimeOffset>();
        stays != nullptr && filter != nullptr) {
      auto late = *stays;
      late.offset_s += Filtered::delay_s_of(*filter);
      effect = late;
      return rest;
    }
    if (const auto* stays = effect.as<effects::SensorBandwidth>();
        stays != nullptr && shift != nullptr) {
      const double delay_s = Filtered::delay_s_of(*stays);
      if (!(delay_s > 0.0) || !(delay_s + shift->offset_s > 0.0)) return std::nullopt;
      auto late = *stays;
      late.cutoff_hz *= delay_s / (delay_s + shift->offset_s);
      effect = late;
      return rest;
    }
  }
  return std::nullopt;
}

}  // namespace

Standing SetBench::without(const Standing& standing, std::size_t effect) const {
  Scenario rest = standing.scenario;
  rest.effects.erase(rest.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  const Scenario as_it_was = rest;
  const auto band = band_of(standing.scenario.effects[effect], conditions_);
  if (band == EffectBand::fast) rest = standing.fitter->with_white_noise_scaled(std::move(rest));
  // What the walk must stand in for has to begin where it can be seen.
  const Beside beside{conditions_, *standing.fitter, standing.fit};
  const double small =
      0.1 * beside.slow_std_dps() / std::sqrt(static_cast<double>(conditions_.cluster()));
  Standing best = refitted(rest);
  if (const auto late = as_late_alone(standing.scenario.effects[effect], rest))
    if (auto other = refitted(*late); other.score > best.score) best = std::move(other);
  // How far it falls short of the whole is of interest when it is little.
  constexpr double little = 30.0;
  const double to_reach = standing.score - little;
  // What is told otherwise may do without it.
  for (std::size_t k = 0; k < rest.effects.size(); ++k)
    if (const auto id = rest.effects[k].id(); band_of(id) == band || id == "g_sensitivity")
      best = told_otherwise(best, k, to_reach);
  if (ArimaLaw::of(rest.random_error).walk_dps < small)
    if (auto other = refitted(with_walk_of_at_least(rest, small)); other.score > best.score)
      best = std::move(other);
  // The motion's other effects had moved beside it.
  if (band == EffectBand::motion)
    if (auto fit = polished(best, to_reach); fit.score > best.score) best = std::move(fit);
  best.beside_the_last = as_it_was;
  return best;
}

Standing SetBench::as_called(const Standing& standing) const {
  Standing best = standing;
  if (standing.score > -1e299) return best;
  for (std::size_t k = 0; k < standing.scenario.effects.size(); ++k) {
    Scenario less = standing.scenario;
    less.effects.erase(less.effects.begin() + static_cast<std::ptrdiff_t>(k));
    if (auto other = refitted(less); other.score > best.score) best = std::move(other);
  }
  return best;
}

Standing SetBench::told_otherwise(const Standing& standing, std::size_t effect,
                                  double to_reach) const {
  const auto& told = standing.scenario.effects[effect];
  const auto& cause = cause_types().named(told.id(), "effects");
  if (cause.told_otherwise == nullptr || is_given(told.id())) return standing;
  // Where nothing shows the form, it stays: a fit that goes on from elsewhere ends a little higher.
  constexpr double clearly = 1.0;
  Standing best = standing;
  for (const auto& other : cause.told_otherwise(told, conditions_)) {
    Scenario scenario = standing.scenario;
    scenario.effects[effect] = other;
    if (auto fit = polished(refitted(scenario), std::max(best.score, to_reach));
        fit.score > std::max(best.score, standing.score + clearly))
      best = std::move(fit);
  }
  return best;
}

}  // namespace gyrostat::gap
