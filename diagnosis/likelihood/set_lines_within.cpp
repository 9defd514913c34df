#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/hidden_line.hpp>
#include <gyrostat/diagnosis/likelihood/line_fits.hpp>
#include <gyrostat/diagnosis/likelihood/line_shape.hpp>
#include <gyrostat/diagnosis/likelihood/line_within.hpp>

namespace gyrostat::gap {

void SetSearcher::join_gated_sines(const std::vector<char>& hidden, FoundSet& found) const {
  if (!bench_.is_allowed("vibration_bursts")) return;
  auto& effects = found.scenario.effects;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    if (effects[k].id() != "vibration" && effects[k].id() != "vibration_bursts") continue;
    const auto band = band_of_line(effects[k]);
    const auto is_within = [&](const Effect& effect) {
      return effect.id() == "sinusoidal" &&
             std::abs(effect.value(field_of(effect, "frequency_hz")) - band.centre_hz) <
                 band.bandwidth_hz;
    };
    const auto sine = std::find_if(effects.begin(), effects.end(), is_within);
    if (sine == effects.end()) continue;
    const double frequency_hz = sine->value(field_of(*sine, "frequency_hz"));
    Scenario without = found.scenario;
    std::erase_if(without.effects, is_within);
    const auto alone = line_shape(conditions_, bench_.rate_left_by(found.scenario, hidden), band);
    const auto joined = line_shape(conditions_, bench_.rate_left_by(without, hidden), band);
    if (joined.bursts < std::max({clear_shape, joined.wandering, alone.bursts})) continue;
    const std::string was(effects[k].id());
    effects[k] =
        with_values("vibration_bursts", {{"std_dps", joined.on_std_dps},
                                         {"centre_hz", frequency_hz},
                                         {"bandwidth_hz", 1.0 / found.scenario.sampling.duration_s},
                                         {"mean_duration_s", joined.on_s},
                                         {"mean_interval_s", joined.off_s}});
    for (auto& member : found.members)
      if (member.effect == was) {
        member.effect = "vibration_bursts";
        member.log_odds = std::min(member.log_odds, joined.bursts);
      }
    std::erase_if(found.intervals, [&](const auto& interval) { return interval.effect == k; });
    const auto known = std::find_if(found.members.begin(), found.members.end(),
                                    [](const auto& m) { return m.effect == "sinusoidal"; });
    const auto elsewhere = known != found.members.end() ? std::optional(*known) : std::nullopt;
    for (auto at = sine; at != effects.end();
         at = std::find_if(effects.begin(), effects.end(), is_within))
      remove(at, found);
    if (elsewhere && has(found.scenario, "sinusoidal")) found.members.push_back(*elsewhere);
    return join_gated_sines(hidden, found);
  }
}

Standing SetSearcher::beside_a_line_within(Standing standing, FoundSet& found) {
  if (!bench_.is_allowed("sinusoidal") || has(standing.scenario, "sinusoidal")) return standing;
  const auto left = bench_.rate_left_by(standing.scenario, bench_.masked());
  for (const auto& effect : standing.scenario.effects) {
    if (effect.id() != "vibration") continue;
    const auto band = band_of_line(effect);
    const auto line = line_within(conditions_, left, band);
    if (!line) continue;
    const auto shape = line_shape(conditions_, left, band);
    if (std::max(shape.bursts, shape.wandering) >= clear_shape) continue;
    bench_.tell_of_line(line->sine.frequency_hz);
    Scenario with = standing.scenario;
    with.effects.emplace_back(line->sine);
    double log_odds =
        line->log_rarity - (bench_.price_of(with) - bench_.price_of(standing.scenario));
    if (log_odds >= clear_shape) {
      auto fit = bench_.refitted(with);
      log_odds = std::min(log_odds, fit.score - standing.score);
      if (log_odds > 0.0) {
        found.members.push_back({"sinusoidal", log_odds});
        return fit;
      }
    }
    bench_.tell_of_line(std::nullopt);
  }
  return standing;
}

}  // namespace gyrostat::gap
