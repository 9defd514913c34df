#include <gyrostat/diagnosis/likelihood/hidden_line.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/motion_left.hpp>

namespace gyrostat::gap {

Resonance band_of_line(const Effect& line) {
  const auto value = [&](std::string_view name) { return line.value(field_of(line, name)); };
  if (line.id() == "wandering_line") {
    // One that forgets where it was before its phase has gone astray fills less than it wanders
    // through (motional narrowing: Kubo, J. Phys. Soc. Japan 9, 1954).
    const double astray = 2.0 * std::numbers::pi * value("wander_hz") * value("correlation_time_s");
    return {0.5 * value("amplitude_dps") * value("amplitude_dps"), value("frequency_hz"),
            2.0 * value("wander_hz") * std::min(1.0, astray)};
  }
  return {value("std_dps") * value("std_dps"), value("centre_hz"), value("bandwidth_hz")};
}

bool are_neighbours(const Resonance& one, const Resonance& other) {
  const double reach_hz = 2.0 * (one.bandwidth_hz + other.bandwidth_hz);
  return std::abs(one.centre_hz - other.centre_hz) <= reach_hz;
}

std::optional<HiddenLine> hidden_line(const SetBench& bench, const Scenario& set,
                                      const std::vector<double>& left_dps, double clear) {
  const auto& conditions = bench.conditions();
  const auto noise = law_of(set, conditions.interval_s());
  const auto& cause = cause_types().named("wandering_line", "effects");
  Scenario with = set;
  with.effects.push_back(cause.effect());
  const double price = bench.price_of(with) - bench.price_of(set);
  // What is left of a motion is there for as long as the motion is.
  clear = std::max(clear, log_gain_of_motion(conditions, left_dps));
  const auto band =
      band_of_hidden_line(conditions, left_dps, noise, price + clear, bench.grid().nyquist_hz());
  const auto is_beside = [&](const Effect& effect) {
    return is_line(effect.id()) && are_neighbours(band_of_line(effect), *band);
  };
  if (!band || std::any_of(set.effects.begin(), set.effects.end(), is_beside)) return std::nullopt;
  const auto track = track_in_band(conditions, left_dps, noise, *band);
  const double log_odds = std::min(track.over_band, track.over_noise - price);
  if (log_odds < clear || !cause.is_what_it_is_called(track.line, conditions)) return std::nullopt;
  return HiddenLine{track.line, log_odds};
}

}  // namespace gyrostat::gap
