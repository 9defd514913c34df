#include <gyrostat/diagnosis/likelihood/hidden_lines.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/motion_left.hpp>

namespace gyrostat::gap {

Resonance band_of_line(const Effect& line) {
  const auto value = [&](std::string_view name) { return line.value(field_of(line, name)); };
  if (line.id() == "wandering_line")
    return {0.5 * value("amplitude_dps") * value("amplitude_dps"), value("frequency_hz"),
            2.0 * value("wander_hz")};
  return {value("std_dps") * value("std_dps"), value("centre_hz"), value("bandwidth_hz")};
}

bool are_neighbours(const Resonance& one, const Resonance& other) {
  const double reach_hz = 2.0 * (one.bandwidth_hz + other.bandwidth_hz);
  return std::abs(one.centre_hz - other.centre_hz) <= reach_hz;
}

std::vector<HiddenLine> hidden_lines(const SetBench& bench, const Scenario& set,
                                     const std::vector<double>& left_dps, double clear) {
  const auto& conditions = bench.conditions();
  const auto noise = law_of(set, conditions.interval_s());
  std::vector<HiddenLine> lines;
  std::vector<Resonance> known;
  for (const auto& effect : set.effects)
    if (is_line(effect.id())) known.push_back(band_of_line(effect));
  const auto is_known = [&](const Resonance& band) {
    return std::any_of(known.begin(), known.end(),
                       [&](const auto& other) { return are_neighbours(band, other); });
  };
  const auto price_of = [&](const CauseType& cause) {
    Scenario with = set;
    with.effects.push_back(cause.effect());
    return bench.price_of(with) - bench.price_of(set);
  };

  // What is left of a motion is there for as long as the motion is.
  clear = std::max(clear, log_gain_of_motion(conditions, left_dps));
  const auto& wandering = cause_types().named("wandering_line", "effects");
  const double price = price_of(wandering);
  if (const auto band = band_of_hidden_line(conditions, left_dps, noise, price + clear);
      band && !is_known(*band)) {
    const auto track = track_in_band(conditions, left_dps, noise, *band);
    const double log_odds = std::min(track.over_band, track.over_noise - price);
    if (log_odds >= clear && wandering.is_what_it_is_called(track.line, conditions)) {
      lines.push_back({track.line, log_odds});
      known.push_back(band_of_line(lines.back().effect));
    }
  }
  return lines;
}

}  // namespace gyrostat::gap
