#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/block_level.hpp>
#include <gyrostat/diagnosis/likelihood/blurred_grid.hpp>
#include <gyrostat/diagnosis/likelihood/dials.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/truncation.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>
#include <gyrostat/generators/effects/dead_zone.hpp>

namespace gyrostat::gap {

void add_mark(std::string_view effect, FoundSet& found) {
  constexpr double odds_of_a_mark = 50.0;
  found.members.push_back({std::string(effect), odds_of_a_mark, true});
}

double white_with_rounding(const Scenario& scenario) {
  const auto law = law_of(scenario, 1.0);
  return std::sqrt(law.white + law.rounding);
}

std::vector<char> SetSearcher::near_the_limit(const Marks& marks) const {
  auto near = marks.clipped;
  const auto& reference = conditions_.series().rate_ref_dps;
  constexpr std::size_t reach = 5;
  constexpr double unbent = 0.95;  // converters bend into their limits
  for (std::size_t i = 0; i < near.size(); ++i) {
    const std::size_t from = i < reach ? 0 : i - reach;
    const std::size_t to = std::min(i + reach + 1, near.size());
    if (std::abs(reference[i]) > unbent * marks.limit_at(reference[i]) ||
        std::any_of(marks.clipped.begin() + static_cast<std::ptrdiff_t>(from),
                    marks.clipped.begin() + static_cast<std::ptrdiff_t>(to),
                    [](char c) { return c != 0; }))
      near[i] = 1;
  }
  return near;
}

Series SetSearcher::as_converted(const Simulator& simulator, Series recording,
                                 const SetSearchOptions& options) {
  auto& z = recording.gyro_dps;
  const auto& without = options.without;
  if (std::find(without.begin(), without.end(), "quantization") != without.end()) return recording;
  const double lsb_dps = step_of_grid(simulator, z, noise_of_steps(simulator.conditions(), z));
  is_cut_off_ = options.is_cut_off || is_cut_off(simulator.conditions(), z, lsb_dps);
  if (is_cut_off_) z = middles_of_cut_off(simulator.conditions(), z, lsb_dps);
  if (lsb_dps > 0.0) return recording;
  if (const auto grid = blurred_grid(simulator, z)) {
    blur_dps_ = grid->noise_dps;
    for (double& value : z) value = grid->nearest_dps(value);
  }
  return recording;
}

std::vector<Effect> SetSearcher::read_off(const Marks& marks, FoundSet& found) {
  std::vector<Effect> effects;
  const auto add = [&](Effect effect) {
    add_mark(effect.id(), found);
    effects.push_back(std::move(effect));
  };
  if (marks.lsb_dps > 0.0 && bench_.is_allowed("quantization"))
    add(with_values("quantization", {{"lsb_dps", marks.lsb_dps},
                                     {"offset_dps", is_cut_off_ ? 0.0 : marks.grid_offset_dps},
                                     {"towards_zero", is_cut_off_ ? 1.0 : 0.0},
                                     {"after_dps", blur_dps_}}));
  if (marks.stale_probability > 0.0 && bench_.is_allowed("stale_samples")) {
    add(with_values("stale_samples", {{"probability", marks.stale_probability},
                                      {"mean_run", marks.stale_run},
                                      {"regular", marks.stale_is_regular ? 1.0 : 0.0},
                                      {"back", static_cast<double>(marks.stale_back)}}));
    bench_.mask_too(marks.repeats);
  }
  if (marks.limit_dps > 0.0 && bench_.is_allowed("saturation")) {
    add(with_values("saturation",
                    {{"limit_dps", marks.limit_dps}, {"below_dps", marks.below_dps}}));
    bench_.mark_saturation();
    bench_.mask_too(near_the_limit(marks));
  }
  if (const auto& zone = marks.silent;
      zone.half_width_dps > 0.0 && bench_.is_allowed("dead_zone")) {
    add(with_values("dead_zone", {{"half_width_dps", zone.half_width_dps},
                                  {"lost_beyond", zone.lost_beyond},
                                  {"of_output", 1.0}}));
    bench_.mark_dead_zone();
    bench_.mask_too(zone.samples);
  }
  repeats_ = bench_.masked();
  return effects;
}

double SetSearcher::noise_about_levels(const std::vector<double>& left) const {
  std::vector<double> of_blocks = {0.0};
  for (const auto& [first, last] : level_blocks(conditions_)) {
    double squares = 0.0, count = 0.0;
    for (std::size_t i = first; i < last; ++i)
      if (!is_missing(left[i])) squares += left[i] * left[i], count += 1.0;
    if (count > 0.0) of_blocks.push_back(squares / count);
  }
  return std::sqrt(quantile(of_blocks, 0.5));
}

double SetSearcher::noise_on_grid(const Scenario& begun, const Marks& marks) const {
  const double white = white_with_rounding(begun);
  if (conditions_.series().rate_ref_dps.empty())
    return std::max({white, marks.noise_of_steps_dps,
                     noise_about_levels(bench_.rate_left_by(begun, bench_.masked()))});
  // What a motion leaves is not seen where neighbours are equal.
  const double of_equal = std::hypot(marks.white_under_grid_dps, marks.lsb_dps / std::sqrt(12.0));
  return std::max(marks.noise_of_steps_dps,
                  marks.white_under_grid_dps > 0.0 ? std::min(white, of_equal) : white);
}

double SetSearcher::feigned_by_repeats(const Marks& marks) const {
  if (marks.repeats_are_told) return 0.0;
  double samples = 1.0;
  for (const auto& span : conditions_.spans(Part::train))
    samples += static_cast<double>(span.size());
  // As many neighbours are alike as are repeated, and as their correlation may be by chance.
  constexpr double deviations = 2.0;
  const double alike = marks.stale_probability + deviations / std::sqrt(samples);
  return 0.5 * samples * alike * alike;
}

void SetSearcher::give_grid_to_angle(const Marks& marks, FoundSet& found) const {
  constexpr double most_apart = 0.2;
  auto& effects = found.scenario.effects;
  const auto angle = std::find_if(effects.begin(), effects.end(),
                                  [](const auto& e) { return e.id() == "angle_quantization"; });
  const auto grid = std::find_if(effects.begin(), effects.end(),
                                 [](const auto& e) { return e.id() == "quantization"; });
  const auto member = std::find_if(found.members.begin(), found.members.end(),
                                   [](const auto& m) { return m.effect == "angle_quantization"; });
  if (grid == effects.end() || angle == effects.end() || member == found.members.end() ||
      member->log_odds < thresholds::clear_odds)
    return;
  const double lsb_deg = marks.lsb_dps * conditions_.interval_s();
  double& coefficient_deg = angle->value(field_of(*angle, "coefficient_deg"));
  if (std::abs(std::sqrt(12.0) * coefficient_deg / lsb_deg - 1.0) > most_apart) return;
  coefficient_deg = lsb_deg / std::sqrt(12.0);
  if (blur_dps_ == 0.0) angle->value(field_of(*angle, "on_grid")) = 1.0;
  remove(grid, found);
  // What was taken for the error of rounding rates.
  double& white = found.scenario.random_error.measurement_noise_std_dps;
  white = std::hypot(white, marks.lsb_dps / std::sqrt(12.0), blur_dps_);
}

void SetSearcher::remove(std::vector<Effect>::iterator effect, FoundSet& found) {
  const auto place = static_cast<std::size_t>(effect - found.scenario.effects.begin());
  std::erase_if(found.members, [&](const auto& m) { return m.effect == effect->id(); });
  found.scenario.effects.erase(effect);
  std::erase_if(found.intervals, [&](const auto& i) { return i.effect == place; });
  for (auto& interval : found.intervals)
    if (interval.effect > place) --interval.effect;
}

void SetSearcher::put_in_order(FoundSet& found) {
  auto& effects = found.scenario.effects;
  std::vector<std::size_t> order(effects.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // An angle's errors come before the limit that clips them, a zone of the output after all that is
  // analogue.
  const auto rank = [&](std::size_t k) {
    if (effects[k].id() == "angle_quantization") return 0;
    const auto* zone = effects[k].as<effects::DeadZone>();
    return zone != nullptr && zone->response() == Response::none ? 2 : 1;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  std::vector<Effect> sorted;
  std::vector<std::size_t> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    sorted.push_back(effects[order[k]]);
    place[order[k]] = k;
  }
  effects = std::move(sorted);
  for (auto& interval : found.intervals) interval.effect = place[interval.effect];
}

/// There noise decides whether a sample is written as 0.
std::vector<char> SetSearcher::edges_of_the_dead_zone(const Scenario& scenario) const {
  constexpr double reach = 5.0;  // standard deviations
  std::vector<char> edges(recording_.size(), 0);
  for (const auto& effect : scenario.effects) {
    if (effect.id() != "dead_zone" || conditions_.series().rate_ref_dps.empty()) continue;
    const auto& zone = *effect.as<effects::DeadZone>();
    Scenario before = scenario;
    std::erase_if(before.effects, [&](const Effect& other) {
      return other.id() == "dead_zone" || zone.response() == Response::of_element;
    });
    const auto sensed = bench_.sensed_rate(before);
    const double near = reach * white_with_rounding(scenario);
    if (near > std::min(zone.half_width_at(1.0), zone.half_width_at(-1.0)))
      continue;  // nothing would be left of it
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const double edge = zone.half_width_at(sensed[i]);
      if (std::abs(std::abs(sensed[i]) - edge) < near) edges[i] = 1;
    }
  }
  return edges;
}

}  // namespace gyrostat::gap
