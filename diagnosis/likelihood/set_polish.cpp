#include <gyrostat/diagnosis/likelihood/set_bench.hpp>

#include <algorithm>
#include <cmath>

#include <tbb/parallel_invoke.h>

#include <gyrostat/diagnosis/likelihood/dials.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>

namespace gyrostat::gap {
namespace {

/// From one scenario through another as far again, times `further`, in what a fit to samples moves.
Scenario beyond(const Scenario& from, const Scenario& through, double further) {
  Scenario there = through;
  for (std::size_t k = 0; k < there.effects.size(); ++k) {
    auto& effect = there.effects[k];
    if (!is_taken_out(effect)) continue;
    for (const auto name : cause_types().named(effect.id(), "effects").free_parameters) {
      const auto f = field_of(effect, name);
      const double value = effect.value(f) + further * (effect.value(f) - from.effects[k].value(f));
      if (effect.fields()[f].range.contains(value)) effect.value(f) = value;
    }
  }
  return there;
}

}  // namespace

/// What is written as 0 says no more of its zone than its edge, and what is clipped has its limit
/// as its value.
bool SetBench::is_read_off(const Effect& effect) const {
  const auto is_zero = [&](std::string_view name) {
    return effect.value(field_of(effect, name)) == 0.0;
  };
  return (marked_dead_zone_ && effect.id() == "dead_zone" && is_zero("lost_beyond")) ||
         (marked_saturation_ && effect.id() == "saturation" && is_zero("of_element"));
}

Standing SetBench::polished(Standing standing, double to_reach) const {
  if (std::none_of(standing.scenario.effects.begin(), standing.scenario.effects.end(),
                   is_taken_out))
    return standing;
  const auto likelihood = [&](const Scenario& scenario) {
    const auto fitter = fitter_of(scenario);
    return fitter ? fitter->terms(scenario).log_likelihood : -1e300;
  };
  Scenario scenario = standing.scenario;
  double here = likelihood(scenario);
  constexpr int fewest_passes = 2, most_passes = 6;
  constexpr double little = 1.0;
  double before_pass = here;
  const double likelihood_to_reach =
      to_reach + standing.fit.log_likelihood - standing.score;  // what parameters cost
  for (int pass = 0; pass < fewest_passes || (pass < most_passes && here > before_pass + little);
       ++pass) {
    before_pass = here;
    const Scenario begun = scenario;
    for (std::size_t at = 0; at < scenario.effects.size(); ++at) {
      auto& effect = scenario.effects[at];
      if (!is_taken_out(effect) || is_read_off(effect)) continue;
      const auto& cause = cause_types().named(effect.id(), "effects");
      for (const auto name : cause.free_parameters) {
        const auto f = field_of(effect, name);
        const double middle = effect.value(f);
        if (middle == 0.0) continue;  // another form has it
        const double step = (pass == 0 ? 0.02 : 0.004) * std::max(std::abs(middle), 1e-9);
        Scenario more = scenario, less = scenario;
        more.effects[at].value(f) = middle + step;
        less.effects[at].value(f) = middle - step;
        double above = 0.0, below = 0.0;
        tbb::parallel_invoke([&] { above = likelihood(more); }, [&] { below = likelihood(less); });
        const double curve = above + below - 2.0 * here;
        const double by =
            curve < 0.0 ? 0.5 * step * (below - above) / curve : (above > below ? step : -step);
        // Of what is linear the parabola is right however far it goes.
        const auto& range = effect.fields()[f].range;
        double there = here - 1.0;
        for (const double furthest : {50.0, 5.0}) {
          if (there > here || (furthest < 50.0 && std::abs(by) <= furthest * step)) break;
          const double bounded = std::clamp(
              middle + std::clamp(by, -furthest * step, furthest * step), range.from, range.to);
          // An end that is not of the range is approached.
          effect.value(f) = range.contains(bounded) ? bounded : 0.5 * (middle + bounded);
          there = likelihood(scenario);
        }
        if (there > here)
          here = there;
        else
          effect.value(f) = middle;
      }
    }
    // Where parameters stand in for each other, a pass goes a little way of a long one.
    for (double further = 1.0; here > before_pass + little; further *= 2.0) {
      const Scenario trial = beyond(begun, scenario, further);
      const double there = likelihood(trial);
      if (there <= here) break;
      scenario = trial;
      here = there;
    }
    if (here + (most_passes - 1 - pass) * (here - before_pass) < likelihood_to_reach) {
      // Under a walk that stood in for what was wrong, what is right gains little.
      const auto fitter = fitter_of(scenario);
      if (!fitter || fitter->terms(with_walk_times(scenario, 0.5)).log_likelihood < here + little)
        return standing;
      auto anew = fitted(scenario, fitter, 8);
      return anew.score > standing.score + little ? polished(std::move(anew), to_reach) : standing;
    }
  }
  return refitted(scenario, 8);
}

}  // namespace gyrostat::gap
