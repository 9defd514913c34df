#include <gyrostat/diagnosis/likelihood/line_names.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/line_shape.hpp>

namespace gyrostat::gap {
namespace {

/// An envelope that is so many times likelier than that of normal noise, as a logarithm.
constexpr double clear_shape = 4.0;

Resonance line_of(const Effect& band) {
  const auto value = [&](std::string_view name) { return band.value(field_of(band, name)); };
  if (band.id() == "vibration")
    return {value("std_dps") * value("std_dps"), value("centre_hz"), value("bandwidth_hz")};
  // As wide as the frequency wanders, or as it does while it is remembered.
  const double wander_hz = value("wander_hz");
  const double fast_hz =
      4.0 * std::numbers::pi * wander_hz * wander_hz * value("correlation_time_s");
  return {0.5 * value("amplitude_dps") * value("amplitude_dps"), value("frequency_hz"),
          std::min(2.0 * wander_hz, fast_hz)};
}

bool is_bursts(const LineShape& shape) {
  return shape.bursts > std::max(shape.wandering, clear_shape);
}

/// A line that fills a band and whose phase wanders by so many radians within a correlation time:
/// few leave it the skirts of a resonance, many none.
Effect wandering_line_in(const Resonance& band, double radians) {
  const double wander_hz = 0.5 * band.bandwidth_hz * std::max(1.0, 1.0 / radians);
  return with_values("wandering_line",
                     {{"amplitude_dps", std::sqrt(2.0 * band.variance)},
                      {"frequency_hz", band.centre_hz},
                      {"wander_hz", wander_hz},
                      {"correlation_time_s", radians / (2.0 * std::numbers::pi * wander_hz)}});
}

/// In the place of a resonance, the likelier of both, fitted.
Standing with_wandering_line(const SetBench& bench, const Standing& standing, std::size_t at) {
  const auto band = line_of(standing.scenario.effects[at]);
  Standing best = standing;
  best.score = -1e300;
  for (const double radians : {3.0, 0.5}) {
    Scenario scenario = standing.scenario;
    scenario.effects[at] = wandering_line_in(band, radians);
    if (best.score < -1e299) best.scenario = scenario;  // as it is where no fit is called so
    constexpr int iterations = 15;
    if (auto fit = bench.fitted(scenario, standing.fitter, iterations); fit.score > best.score)
      best = std::move(fit);
  }
  return best;
}

}  // namespace

std::vector<char> samples_in_bursts(const SetBench& bench, const Scenario& scenario,
                                    const std::vector<double>& left_dps) {
  std::vector<char> inside(left_dps.size(), 0);
  for (const auto& effect : scenario.effects) {
    if (!is_narrow_band(effect.id())) continue;
    const auto line = line_of(effect);
    const auto shape = line_shape(bench.conditions(), left_dps, line);
    if (!is_bursts(shape)) continue;
    const auto found = samples_in_bursts(bench.conditions(), left_dps, line, shape);
    for (std::size_t i = 0; i < inside.size(); ++i) inside[i] |= found[i];
  }
  return inside;
}

void name_lines(const SetBench& bench, Standing standing, const std::vector<char>& hidden,
                FoundSet& found) {
  // Lines are not taken out, so that what is left is the same whatever they are called.
  const auto left = bench.rate_left_by(found.scenario, hidden);
  auto& effects = found.scenario.effects;
  std::vector<LineShape> shapes(effects.size());
  tbb::parallel_for(std::size_t{0}, shapes.size(), [&](std::size_t k) {
    if (is_narrow_band(effects[k].id()))
      shapes[k] = line_shape(bench.conditions(), left, line_of(effects[k]));
  });
  for (std::size_t k = 0; k < effects.size(); ++k) {
    auto& effect = effects[k];
    if (!is_narrow_band(effect.id())) continue;
    const auto line = line_of(effect);
    const auto& shape = shapes[k];
    const double gain = std::max(shape.bursts, shape.wandering);
    const std::string_view name = gain < clear_shape ? "vibration"
                                  : is_bursts(shape) ? "vibration_bursts"
                                                     : "wandering_line";
    if (name == effect.id() && gain < clear_shape) continue;
    const auto known = std::find_if(found.members.begin(), found.members.end(),
                                    [&](const auto& m) { return m.effect == effect.id(); });
    if (!bench.is_allowed(name)) {
      const double odds = known != found.members.end() ? known->log_odds : clear_shape;
      found.nameless_log_odds = std::max(found.nameless_log_odds, gain < clear_shape ? odds : gain);
      if (known != found.members.end()) found.members.erase(known);
      continue;
    }
    if (known != found.members.end()) {
      known->effect = name;
      if (gain >= clear_shape) known->log_odds = std::min(known->log_odds, gain);
    }
    if (name == effect.id()) continue;
    // Those of the form that it was found in are not those of what it is called.
    std::erase_if(found.intervals, [&](const auto& interval) { return interval.effect == k; });
    if (name == "vibration") {
      effect = with_values(name, {{"std_dps", std::sqrt(line.variance)},
                                  {"centre_hz", line.centre_hz},
                                  {"bandwidth_hz", line.bandwidth_hz}});
    } else if (name == "vibration_bursts") {
      effect = with_values(name, {{"std_dps", shape.on_std_dps},
                                  {"centre_hz", line.centre_hz},
                                  {"bandwidth_hz", line.bandwidth_hz},
                                  {"mean_duration_s", shape.on_s},
                                  {"mean_interval_s", shape.off_s}});
    } else {
      standing = with_wandering_line(bench, standing, k);
      found.scenario.random_error = standing.scenario.random_error;
      for (std::size_t other = 0; other < standing.scenario.effects.size(); ++other)
        if (effects[other].id() == standing.scenario.effects[other].id() || other == k)
          effects[other] = standing.scenario.effects[other];
    }
  }
  // One name each, however many lines it has.
  auto& members = found.members;
  for (std::size_t k = 1; k < members.size();)
    if (std::any_of(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(k),
                    [&](const auto& m) { return m.effect == members[k].effect; }))
      members.erase(members.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
  for (const auto& effect : effects)
    if ((!is_narrow_band(effect.id()) || found.nameless_log_odds == 0.0) &&
        std::none_of(members.begin(), members.end(),
                     [&](const auto& m) { return m.effect == effect.id(); }))
      members.push_back({std::string(effect.id()), clear_shape});
}

}  // namespace gyrostat::gap
