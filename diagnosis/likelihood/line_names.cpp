#include <gyrostat/diagnosis/likelihood/line_names.hpp>

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/hidden_bursts.hpp>
#include <gyrostat/diagnosis/likelihood/hidden_line.hpp>
#include <gyrostat/diagnosis/likelihood/line_fits.hpp>
#include <gyrostat/diagnosis/likelihood/line_shape.hpp>

namespace gyrostat::gap {
namespace {

bool is_bursts(const LineShape& shape) {
  return shape.bursts > std::max(shape.wandering, clear_shape);
}

/// Of the line among the set's.
LineTrack track_of(const Conditions& conditions, const std::vector<double>& left,
                   const Scenario& set, std::size_t line) {
  Scenario beside = set;
  beside.effects.erase(beside.effects.begin() + static_cast<std::ptrdiff_t>(line));
  return track_in_band(conditions, left, law_of(beside, conditions.interval_s()),
                       band_of_line(set.effects[line]));
}

/// What two neighbouring bands are together.
Resonance joined(const Resonance& a, const Resonance& b) {
  const double variance = a.variance + b.variance;
  const double centre_hz = (a.variance * a.centre_hz + b.variance * b.centre_hz) / variance;
  const double apart_hz = std::abs(a.centre_hz - b.centre_hz);
  const double spread_hz = std::sqrt(a.variance * b.variance) / variance * apart_hz;
  const double bandwidth_hz =
      (a.variance * a.bandwidth_hz + b.variance * b.bandwidth_hz) / variance;
  return {variance, centre_hz, std::hypot(bandwidth_hz, 2.0 * spread_hz)};
}

/// The spectrum of a line that wanders is not that of a resonance, and is found as several side by
/// side. They are parts of it where two together have the envelope of a sine more clearly than
/// alone: by how much, an effect each; 0 where they have not.
std::vector<double> parts_of_wandering_lines(const SetBench& bench, const std::vector<double>& left,
                                             const Scenario& scenario,
                                             const std::vector<LineShape>& shapes) {
  const auto& effects = scenario.effects;
  std::vector<double> gains(effects.size(), 0.0);
  for (std::size_t a = 0; a < effects.size(); ++a)
    for (std::size_t b = a + 1; b < effects.size(); ++b) {
      if (!is_line(effects[a].id()) || !is_line(effects[b].id())) continue;
      const auto one = band_of_line(effects[a]), other = band_of_line(effects[b]);
      if (!are_neighbours(one, other)) continue;
      const double together = line_shape(bench.conditions(), left, joined(one, other)).wandering;
      if (together < clear_shape || together <= std::max(shapes[a].wandering, shapes[b].wandering))
        continue;
      gains[a] = std::max(gains[a], together);
      gains[b] = std::max(gains[b], together);
    }
  return gains;
}

/// However many lines it has.
void one_name_each(FoundSet& found) {
  auto& members = found.members;
  for (std::size_t k = 1; k < members.size();)
    if (std::any_of(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(k),
                    [&](const auto& m) { return m.effect == members[k].effect; }))
      members.erase(members.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
  for (const auto& effect : found.scenario.effects)
    if ((!is_line(effect.id()) || found.nameless_log_odds == 0.0) &&
        std::none_of(members.begin(), members.end(),
                     [&](const auto& m) { return m.effect == effect.id(); }))
      members.push_back({std::string(effect.id()), clear_shape});
}

/// The noise and the other effects as they were fitted beside lines of other names.
void take_over(const Standing& standing, Scenario& scenario) {
  scenario.random_error = standing.scenario.random_error;
  for (std::size_t k = 0; k < standing.scenario.effects.size(); ++k)
    if (scenario.effects[k].id() == standing.scenario.effects[k].id())
      scenario.effects[k] = standing.scenario.effects[k];
}

}  // namespace

std::vector<char> samples_in_bursts(const SetBench& bench, const Scenario& scenario,
                                    const std::vector<double>& left_dps) {
  std::vector<char> inside(left_dps.size(), 0);
  for (const auto& effect : scenario.effects) {
    if (!is_line(effect.id())) continue;
    const auto line = band_of_line(effect);
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
  std::vector<LineTrack> tracks(effects.size());
  tbb::parallel_for(std::size_t{0}, shapes.size(), [&](std::size_t k) {
    if (!is_line(effects[k].id())) return;
    shapes[k] = line_shape(bench.conditions(), left, band_of_line(effects[k]));
    tracks[k] = track_of(bench.conditions(), left, found.scenario, k);
    shapes[k].wandering = std::max(shapes[k].wandering, tracks[k].over_band);
  });
  const auto parts = parts_of_wandering_lines(bench, left, found.scenario, shapes);
  bool refitted = false;
  // The strongest first: what it takes of the others' bands they are fitted without.
  std::vector<Resonance> wandering;
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < effects.size(); ++k)
    if (is_line(effects[k].id())) order.push_back(k);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return band_of_line(effects[a]).variance > band_of_line(effects[b]).variance;
  });
  for (const std::size_t k : order) {
    auto& effect = effects[k];
    const auto line = band_of_line(effect);
    const auto& shape = shapes[k];
    // Where a line seldom wanders to it comes and goes.
    const bool is_edge = std::any_of(wandering.begin(), wandering.end(),
                                     [&](const auto& w) { return are_neighbours(w, line); });
    const bool bursts = is_bursts(shape) && parts[k] == 0.0 && !is_edge;
    const double gain = std::max({shape.bursts, shape.wandering, parts[k]});
    const std::string_view name = bursts ? "vibration_bursts" : "wandering_line";
    const auto known = std::find_if(found.members.begin(), found.members.end(),
                                    [id = effect.id()](const auto& m) { return m.effect == id; });
    if (gain < clear_shape) {
      if (effect.id() == "vibration") continue;
      // Its spectrum alone does not tell it from noise in that band.
      if (!bench.is_allowed("vibration")) {
        found.nameless_log_odds = std::max(found.nameless_log_odds, clear_shape);
        if (known != found.members.end()) found.members.erase(known);
        continue;
      }
      standing = with_resonance(bench, standing, k);
      effect = standing.scenario.effects[k];
      std::erase_if(found.intervals, [&](const auto& interval) { return interval.effect == k; });
      refitted = true;
      if (known != found.members.end()) known->effect = "vibration";
      continue;
    }
    if (!bench.is_allowed(name)) {
      found.nameless_log_odds = std::max(found.nameless_log_odds, gain);
      if (known != found.members.end()) found.members.erase(known);
      continue;
    }
    // Those of the band are not those of what it is called.
    if (effect.id() != name)
      std::erase_if(found.intervals, [&](const auto& interval) { return interval.effect == k; });
    if (bursts) {
      effect = with_values("vibration_bursts", {{"std_dps", shape.on_std_dps},
                                                {"centre_hz", line.centre_hz},
                                                {"bandwidth_hz", line.bandwidth_hz},
                                                {"mean_duration_s", shape.on_s},
                                                {"mean_interval_s", shape.off_s}});
    } else if (effect.id() != name) {
      const bool is_followed = tracks[k].over_band >= shape.wandering;
      standing = with_wandering_line(bench, standing, k, is_followed ? tracks[k] : LineTrack{});
      effect = standing.scenario.effects[k];
      refitted = true;
    }
    if (!bursts) wandering.push_back(line);
    if (known != found.members.end()) {
      known->effect = name;
      known->log_odds = std::min(known->log_odds, gain);
    }
  }
  const auto gets_its_name = [&](const HiddenLine& more) {
    if (bench.is_allowed(more.line.id())) {
      found.members.push_back({std::string(more.line.id()), more.log_odds});
      return true;
    }
    found.nameless_log_odds = std::max(found.nameless_log_odds, more.log_odds);
    return false;
  };
  if (const auto more = hidden_line(bench, standing.scenario, left, clear_shape);
      more && gets_its_name(*more)) {
    standing = with_line(bench, std::move(standing), more->line);
    effects.push_back(standing.scenario.effects.back());
    refitted = true;
  }
  if (!has(found.scenario, "vibration_bursts"))
    if (const auto more = hidden_bursts(bench, found.scenario, left, clear_shape);
        more && gets_its_name(*more))
      effects.push_back(more->line);
  if (refitted) take_over(standing, found.scenario);
  for (auto& effect : effects)
    if (effect.id() == "wandering_line") hold_within(bench.conditions(), effect);
  one_name_each(found);
}

}  // namespace gyrostat::gap
