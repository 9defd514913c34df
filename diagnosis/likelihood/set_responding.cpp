#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

#include <algorithm>
#include <optional>
#include <vector>

#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/motion_left.hpp>
#include <gyrostat/diagnosis/likelihood/response_left.hpp>
#include <gyrostat/diagnosis/starts/late_filter.hpp>

namespace gyrostat::gap {

bool SetSearcher::leaves_of_the_motion(const Standing& standing) const {
  if (!conditions_.has_motion()) return false;
  return bench_.response() ||
         log_gain_of_motion(conditions_, bench_.rate_left_by(standing.scenario, bench_.masked())) >
             clear_response;
}

std::vector<Standing> SetSearcher::late_beginnings(const Evidence& left, Scenario still) const {
  // Whatever else is there may stand for what neither explains.
  std::erase_if(still.effects, [&](const auto& effect) { return !bench_.is_marked(effect.id()); });
  std::vector<Standing> all;
  for (const auto& both : late_filters(left)) {
    auto effects = still.effects;
    effects.insert(effects.end(), both.begin(), both.end());
    all.push_back(bench_.polished(bench_.beside_noise(std::move(effects))));
  }
  return all;
}

Standing SetSearcher::responding_anew(const Standing& standing) {
  const bool filters = has(standing.scenario, "sensor_bandwidth");
  const bool shifts = has(standing.scenario, "time_offset");
  const std::string_view other = filters ? "time_offset" : "sensor_bandwidth";
  const bool may_filter = bench_.is_allowed("sensor_bandwidth"),
             may_shift = bench_.is_allowed("time_offset");
  const bool is_one = filters != shifts && (filters ? may_shift : may_filter);
  // Where both are there neither need stand, or both beside something else.
  const bool are_two = may_filter && may_shift && leaves_of_the_motion(standing);
  if (!is_one && !are_two) return standing;
  Scenario still = standing.scenario;
  std::erase_if(still.effects, [&](const auto& effect) {
    return !bench_.is_marked(effect.id()) && band_of(effect.id()) == EffectBand::motion;
  });
  const auto response = bench_.response();
  const auto masked = bench_.masked();
  // What is late by the one or the other shows where the motion is least known.
  const bool hidden = hides_response();
  auto shown = standing;
  if (hidden) {
    bench_.mask_only(hidden_from_response_);
    shown = bench_.refitted(standing.scenario);
  }
  bench_.take_out_response(std::nullopt);
  // Beside a motion without its effects what is there may be fitted to what it is not.
  auto rest = bench_.refitted(still);
  if (rest.score < -1e299) rest = bench_.refitted(still, 0);
  const auto left = bench_.evidence_of(rest);
  auto best = shown;
  if (is_one)
    best = best_from(best, {bench_.with(rest, cause_types().named(other, "effects"), &left)},
                     EffectBand::motion);
  bool is_likelier = best.score > shown.score;
  if (are_two) {
    // A response without a name is an effect, too, whose eight sizes gain half a nat by chance.
    constexpr double by_chance = 4.0;
    auto one = best;
    if (response && !is_likelier) one.score -= least_gain(one, EffectBand::fast) + by_chance;
    // In its place nothing may pass for noise.
    const auto two = best_from(one, late_beginnings(left, still),
                               response ? std::optional(EffectBand::motion) : std::nullopt);
    if (two.score > one.score) {
      best = two;
      is_likelier = true;
    }
  }
  if (!is_likelier) bench_.take_out_response(response);
  if (!hidden) return is_likelier ? best : standing;
  bench_.mask_only(masked);
  return is_likelier ? bench_.refitted(best.scenario) : standing;
}

Standing SetSearcher::responding_without_names(Standing standing) {
  constexpr std::ptrdiff_t fewest_that_bend = 2;
  const auto bends = [&](const Effect& effect) {
    return !bench_.is_marked(effect.id()) &&
           (effect.id() == "dead_zone" || effect.id() == "saturation" ||
            effect.id() == "scale_asymmetry");
  };
  const auto& effects = standing.scenario.effects;
  if (bench_.response() || std::count_if(effects.begin(), effects.end(), bends) < fewest_that_bend)
    return standing;
  Scenario still = standing.scenario;
  std::erase_if(still.effects, [&](const auto& effect) {
    return !bench_.is_marked(effect.id()) && band_of(effect.id()) == EffectBand::motion;
  });
  // A response shows where the motion is least known.
  const auto masked = bench_.masked();
  auto named = standing;
  if (hides_response()) {
    bench_.mask_only(hidden_from_response_);
    named = bench_.refitted(standing.scenario);
  }
  if (auto response = whole_response(bench_, still)) {
    bench_.take_out_response(std::move(response));
    // What bends leaves more than a linear response explains: together they stand where that is
    // clear alone.
    if (auto fit = bench_.refitted(still); fit.score > named.score - clear_response) return fit;
  }
  bench_.take_out_response(std::nullopt);
  bench_.mask_only(masked);
  return standing;
}

}  // namespace gyrostat::gap
