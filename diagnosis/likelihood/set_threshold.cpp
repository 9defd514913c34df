#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/generators/effects/dead_zone.hpp>

namespace gyrostat::gap {
namespace {

/// A sample near an edge: how fast it is sensed to turn, and what the squares gain by its being
/// below the threshold.
struct BesideEdge {
  double speed_dps, gain;
};

/// Between which speeds the threshold lies, by the least squares of either side; the same where
/// they say nothing.
std::pair<double, double> edge_between(std::vector<BesideEdge> beside, double known_dps) {
  std::sort(beside.begin(), beside.end(),
            [](const auto& a, const auto& b) { return a.speed_dps < b.speed_dps; });
  std::size_t below = 0;
  double sum = 0.0, most = 0.0;
  for (std::size_t k = 0; k < beside.size(); ++k)
    if (sum += beside[k].gain; sum > most) most = sum, below = k + 1;
  if (below == 0 || below == beside.size()) return {known_dps, known_dps};
  return {beside[below - 1].speed_dps, beside[below].speed_dps};
}

}  // namespace

void SetSearcher::place_threshold(FoundSet& found) const {
  auto& effects = found.scenario.effects;
  const auto place = std::find_if(effects.begin(), effects.end(),
                                  [](const auto& effect) { return effect.id() == "dead_zone"; });
  if (place == effects.end()) return;
  const auto zone = *place->as<effects::DeadZone>();
  const double jump_dps =
      (1.0 - zone.lost_beyond) * std::min(zone.half_width_at(1.0), zone.half_width_at(-1.0));
  const double white = white_with_rounding(found.scenario);
  constexpr double clear = 3.0, outlying = 8.0;
  if (zone.of_output > 0.5 || zone.dither > 0.0 || jump_dps < clear * white) return;
  // What a filter makes of the jump has no edge.
  if (zone.response() == Response::of_element && has(found.scenario, "sensor_bandwidth")) return;

  Scenario nowhere = found.scenario, everywhere = found.scenario;
  const auto at = place - effects.begin();
  nowhere.effects.erase(nowhere.effects.begin() + at);
  everywhere.effects[static_cast<std::size_t>(at)].value(field_of(*place, "half_width_dps")) =
      std::numeric_limits<double>::max();
  everywhere.effects[static_cast<std::size_t>(at)].value(field_of(*place, "below_dps")) = 0.0;
  auto rate = bench_.sensed_rate(nowhere);
  const auto silent = bench_.sensed_rate(everywhere);
  for (std::size_t i = 0; i < rate.size(); ++i) rate[i] -= silent[i];
  const auto left = bench_.rate_left_by(found.scenario, repeats_);

  const bool is_even = zone.below_dps == 0.0;
  const auto edge = [&](double side) {
    std::vector<BesideEdge> beside;
    const double width = zone.half_width_at(side), lost_dps = zone.lost_beyond * width;
    for (const auto& span : conditions_.spans(Part::train))
      for (std::size_t i = span.first; i < span.last; ++i) {
        const double speed = std::abs(rate[i]);
        if (is_missing(left[i]) || std::abs(speed - width) > 0.5 * width ||
            (!is_even && rate[i] * side < 0.0))
          continue;
        const double lost = std::copysign(lost_dps, rate[i]);
        const double now = speed <= width ? rate[i] : lost;
        const auto square = [&](double by) {
          return std::pow(std::min(std::abs(left[i] + by - now), outlying * white), 2);
        };
        beside.push_back({speed, square(lost) - square(rate[i])});
      }
    return edge_between(std::move(beside), width);
  };
  const auto set = [&](std::string_view field, const std::pair<double, double>& between) {
    const auto [low, high] = between;
    place->value(field_of(*place, field)) = 0.5 * (low + high);
    for (auto& interval : found.intervals)
      if (interval.effect == static_cast<std::size_t>(at) && low < high &&
          place->fields()[interval.field].name == field)
        interval.low = low, interval.high = high;
  };
  const auto above = edge(1.0);
  set("half_width_dps", above);
  if (!is_even) return set("below_dps", edge(-1.0));
  // What larger rates lose was found from them.
  place->value(field_of(*place, "lost_beyond")) =
      zone.lost_beyond * zone.half_width_dps / (0.5 * (above.first + above.second));
}

}  // namespace gyrostat::gap
