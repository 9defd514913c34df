#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/generators/effects/dead_zone.hpp>

namespace gyrostat::gap {

void SetSearcher::place_threshold(FoundSet& found) const {
  auto& effects = found.scenario.effects;
  const auto place = std::find_if(effects.begin(), effects.end(),
                                  [](const auto& effect) { return effect.id() == "dead_zone"; });
  if (place == effects.end()) return;
  effects::DeadZone zone = *place->as<effects::DeadZone>();
  const double lost_dps = zone.lost_beyond * zone.half_width_dps;
  const double jump_dps = zone.half_width_dps - lost_dps;
  const double white = white_with_rounding(found.scenario);
  constexpr double clear = 3.0, outlying = 8.0;
  if (zone.of_output > 0.5 || zone.dither > 0.0 || jump_dps < clear * white) return;

  Scenario nowhere = found.scenario, everywhere = found.scenario;
  const auto at = place - effects.begin();
  nowhere.effects.erase(nowhere.effects.begin() + at);
  everywhere.effects[static_cast<std::size_t>(at)].value(field_of(*place, "half_width_dps")) =
      std::numeric_limits<double>::max();
  auto rate = bench_.sensed_rate(nowhere);
  const auto silent = bench_.sensed_rate(everywhere);
  for (std::size_t i = 0; i < rate.size(); ++i) rate[i] -= silent[i];
  const auto left = bench_.rate_left_by(found.scenario, repeats_);

  struct Sample {
    double speed_dps, gain;  ///< by its being below the threshold, in squares
  };
  std::vector<Sample> beside;
  for (const auto& span : conditions_.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      const double speed = std::abs(rate[i]);
      if (is_missing(left[i]) || std::abs(speed - zone.half_width_dps) > 0.5 * zone.half_width_dps)
        continue;
      const double lost = std::copysign(lost_dps, rate[i]);
      const double now = speed <= zone.half_width_dps ? rate[i] : lost;
      const auto square = [&](double by) {
        return std::pow(std::min(std::abs(left[i] + by - now), outlying * white), 2);
      };
      beside.push_back({speed, square(lost) - square(rate[i])});
    }
  std::sort(beside.begin(), beside.end(),
            [](const auto& a, const auto& b) { return a.speed_dps < b.speed_dps; });
  std::size_t below = 0;
  double sum = 0.0, most = 0.0;
  for (std::size_t k = 0; k < beside.size(); ++k)
    if (sum += beside[k].gain; sum > most) most = sum, below = k + 1;
  if (below == 0 || below == beside.size()) return;

  const double low = beside[below - 1].speed_dps, high = beside[below].speed_dps;
  zone.half_width_dps = 0.5 * (low + high);
  zone.lost_beyond = lost_dps / zone.half_width_dps;
  *place = zone;
  for (auto& interval : found.intervals)
    if (interval.effect == static_cast<std::size_t>(at) &&
        place->fields()[interval.field].name == "half_width_dps")
      interval.low = low, interval.high = high;
}

}  // namespace gyrostat::gap
