#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/hidden_line.hpp>

namespace gyrostat::gap {
namespace {

/// What settles about as fast as a filter or a shift of time follows the rate is what they do not
/// know of before the first sample.
bool is_what_was_before(const Effect& effect, const Scenario& scenario) {
  if (effect.id() != "start_up") return false;
  constexpr double as_fast = 5.0;
  double follows_s = 0.0;
  for (const auto& other : scenario.effects) {
    const auto value = [&](std::string_view name) { return other.value(field_of(other, name)); };
    if (other.id() == "time_offset") follows_s += std::abs(value("offset_s"));
    if (other.id() == "sensor_bandwidth")
      follows_s += 0.5 / (std::numbers::pi * value("cutoff_hz"));
  }
  return effect.value(field_of(effect, "settling_time_s")) < as_fast * follows_s;
}

/// A line that a few bursts are is a comb of sines, and what its band leaves of them is another
/// sine; so is what is left of one whose band is as narrow as a spectrum of this length can tell.
bool is_part_of_a_line(const Effect& effect, const Scenario& scenario, double duration_s) {
  constexpr double fewest_cycles = 32.0;  // of a band's own time, beside which a sine is told
  if (effect.id() != "sinusoidal") return false;
  const Resonance sine{0.0, effect.value(field_of(effect, "frequency_hz")), 0.0};
  return std::any_of(scenario.effects.begin(), scenario.effects.end(), [&](const auto& other) {
    if (!is_line(other.id())) return false;
    const auto band = band_of_line(other);
    return band.bandwidth_hz * duration_s < fewest_cycles && are_neighbours(sine, band);
  });
}

}  // namespace

Standing SetSearcher::without_what_others_are(Standing standing, FoundSet& found) const {
  const double duration_s = conditions_.interval_s() * static_cast<double>(conditions_.size());
  auto scenario = standing.scenario;
  if (std::erase_if(scenario.effects, [&](const auto& effect) {
        return is_what_was_before(effect, standing.scenario) ||
               is_part_of_a_line(effect, standing.scenario, duration_s);
      }) == 0)
    return standing;
  std::erase_if(found.members, [&](const auto& m) {
    return has(standing.scenario, m.effect) && !has(scenario, m.effect);
  });
  return bench_.refitted(scenario);
}

Standing SetSearcher::without_the_doubtful(Standing standing, FoundSet& found) const {
  // Of names given at less, in six blind checks of sets, a third were right: the best of several
  // forms gains as much by chance.
  constexpr double least_odds = 0.5;
  std::vector<std::string> kept;
  const auto weakest = [&] {
    auto least = found.members.end();
    for (auto m = found.members.begin(); m != found.members.end(); ++m)
      if (!m->read_off && !m->given && m->log_odds < least_odds &&
          has(standing.scenario, m->effect) &&
          std::find(kept.begin(), kept.end(), m->effect) == kept.end() &&
          (least == found.members.end() || m->log_odds < least->log_odds))
        least = m;
    return least;
  };
  for (auto member = weakest(); member != found.members.end(); member = weakest()) {
    const auto& effects = standing.scenario.effects;
    const auto effect = std::find_if(effects.begin(), effects.end(),
                                     [&](const auto& e) { return e.id() == member->effect; });
    auto rest = bench_.as_called(
        bench_.without(standing, static_cast<std::size_t>(effect - effects.begin())));
    // A rival may be as likely in its place, and then nothing is not.
    if (standing.score - rest.score >= least_odds) {
      kept.push_back(member->effect);
      continue;
    }
    std::erase_if(found.rivals, [&](const auto& r) { return r.instead_of == member->effect; });
    found.rivals.push_back({*effect, member->effect, "", member->log_odds - least_odds});
    standing = std::move(rest);
    if (!has(standing.scenario, member->effect)) found.members.erase(member);
  }
  return standing;
}

}  // namespace gyrostat::gap
