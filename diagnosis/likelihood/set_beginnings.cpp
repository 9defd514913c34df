#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

#include <algorithm>

#include <gyrostat/diagnosis/likelihood/beside.hpp>
#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/hidden_line.hpp>
#include <gyrostat/diagnosis/likelihood/motion_left.hpp>
#include <gyrostat/diagnosis/likelihood/response_left.hpp>
#include <gyrostat/diagnosis/starts/late_filter.hpp>
#include <gyrostat/generators/effects/gauss_markov.hpp>

namespace gyrostat::gap {
namespace {

/// Too narrow to stand in for a filter.
bool is_a_line(const Effect& effect) {
  constexpr double narrow = 0.25;
  if (!is_line(effect.id())) return effect.id() == "sinusoidal";
  const auto band = band_of_line(effect);
  return band.bandwidth_hz < narrow * band.centre_hz;
}

}  // namespace

Standing SetSearcher::coloured_anew(const Standing& standing) {
  const auto colours = [&](std::string_view effect) {
    return !bench_.is_marked(effect) && band_of(effect) == EffectBand::fast;
  };
  const auto& effects = standing.scenario.effects;
  if (std::count_if(effects.begin(), effects.end(),
                    [&](const auto& effect) { return colours(effect.id()); }) < 2)
    return standing;
  Scenario plain = standing.scenario;
  std::erase_if(plain.effects,
                [&](const auto& effect) { return colours(effect.id()) && !is_a_line(effect); });
  // Not fitted: what is slow would take up what filters explain.
  const auto rest =
      bench_.fitted(standing.fitter->with_white_noise_scaled(std::move(plain)), standing.fitter, 0);
  const auto& angle = cause_types().named("angle_quantization", "effects");
  Scenario with_angle = rest.scenario;
  with_angle.effects.push_back(angle.guesses(Beside{conditions_, *rest.fitter, rest.fit}).front());
  const auto beside_angle = bench_.fitted(with_angle, rest.fitter, 0);
  std::vector<Standing> firsts;
  for (const auto* id : {"noise_averaging", "noise_bandwidth"}) {
    if (!bench_.is_allowed(id) || bench_.is_marked(id)) continue;
    const auto& filter = cause_types().named(id, "effects");
    firsts.push_back(bench_.with(rest, filter, nullptr));
    if (!bench_.is_allowed(angle.id) || bench_.is_marked(angle.id)) continue;
    // Beside a filter that stands in for both an angle's errors gain nothing.
    if (auto both = bench_.with(beside_angle, filter, nullptr); both.score > firsts.back().score)
      firsts.push_back(std::move(both));
  }
  return best_from(standing, std::move(firsts), EffectBand::fast);
}

Standing SetSearcher::without_wide_lines(const Standing& standing) {
  const auto& angle = cause_types().named("angle_quantization", "effects");
  if (!bench_.is_allowed(angle.id) || bench_.is_marked(angle.id) ||
      has(standing.scenario, angle.id))
    return standing;
  Scenario plain = standing.scenario;
  if (std::erase_if(plain.effects, [](const auto& effect) {
        return is_line(effect.id()) && !is_a_line(effect);
      }) == 0)
    return standing;
  Scenario still = plain;
  std::erase_if(still.effects, [](const auto& effect) { return is_slow(effect.id()); });
  std::vector<Standing> firsts;
  for (const auto& beginning : {plain, still}) {
    const auto rest =
        bench_.fitted(standing.fitter->with_white_noise_scaled(beginning), standing.fitter, 0);
    firsts.push_back(bench_.with(rest, angle, nullptr));
  }
  // Three effects in the place of one are no surer for a few nats.
  constexpr double clear = 10.0;
  auto best = best_from(standing, std::move(firsts), std::nullopt);
  return best.score > standing.score + clear ? best : standing;
}

bool SetSearcher::leaves_of_the_motion(const Standing& standing) const {
  if (!conditions_.has_motion()) return false;
  return bench_.response() ||
         log_gain_of_motion(conditions_, bench_.rate_left_by(standing.scenario, bench_.masked())) >
             clear_response;
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
    // Whatever else is there may stand for what neither explains.
    auto marked = still.effects;
    std::erase_if(marked, [&](const auto& effect) { return !bench_.is_marked(effect.id()); });
    std::vector<Standing> firsts;
    for (const auto& both : late_filters(left)) {
      auto effects = marked;
      effects.insert(effects.end(), both.begin(), both.end());
      firsts.push_back(bench_.polished(bench_.beside_noise(std::move(effects))));
    }
    // A response without a name is an effect, too, whose eight sizes gain half a nat by chance.
    constexpr double by_chance = 4.0;
    auto one = best;
    if (response && !is_likelier) one.score -= least_gain(one, EffectBand::fast) + by_chance;
    // In its place nothing may pass for noise.
    const auto two = best_from(one, std::move(firsts),
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

Standing SetSearcher::best_from(const Standing& standing, std::vector<Standing> beginnings,
                                std::optional<EffectBand> band) {
  const auto all = candidates_;
  std::erase_if(candidates_, [&](const auto* cause) {
    return bench_.is_marked(cause->id) || (band && band_of(cause->id) != *band);
  });
  const auto gains = gains_;
  auto gains_of_best = gains_;
  const double least = least_gain(standing, band.value_or(EffectBand::fast));
  Standing best = standing;
  double most = standing.score;
  for (const auto& beginning : beginnings) {
    if (beginning.score < -1e299) continue;
    gains_ = gains;
    auto other = searched(beginning);
    // What stands in the place of another is no further effect.
    const auto further = static_cast<double>(other.scenario.effects.size()) -
                         static_cast<double>(standing.scenario.effects.size());
    const double worth = other.score - least * std::max(0.0, further);
    if (worth <= most) continue;
    most = worth;
    best = std::move(other);
    gains_of_best = gains_;
  }
  gains_ = std::move(gains_of_best);
  candidates_ = all;
  return best;
}

Standing SetSearcher::beside_memory(const Standing& standing) const {
  if (standing.scenario.random_error.phi != 0.0) return {};
  Standing best = bench_.beside_memory(standing);
  const auto try_without = [&](const auto& is_in_its_place) {
    Scenario plain = standing.scenario;
    std::erase_if(plain.effects, [&](const auto& effect) {
      return !bench_.is_marked(effect.id()) && is_in_its_place(effect);
    });
    if (plain.effects.size() == standing.scenario.effects.size()) return;
    if (auto other = bench_.beside_memory(bench_.refitted(plain)); other.score > best.score)
      best = std::move(other);
  };
  try_without([](const Effect& effect) { return band_of(effect.id()) == EffectBand::fast; });
  // A walk whose steps remember one another is smooth, too.
  try_without([](const Effect& effect) {
    const auto* process = effect.as<effects::GaussMarkov>();
    return process != nullptr && process->is_of_second_order();
  });
  return best;
}

}  // namespace gyrostat::gap
