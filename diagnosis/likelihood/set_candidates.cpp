#include <gyrostat/diagnosis/likelihood/set_bench.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_invoke.h>

#include <gyrostat/diagnosis/likelihood/beside.hpp>
#include <gyrostat/diagnosis/likelihood/dials.hpp>
#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>

namespace gyrostat::gap {
namespace {

/// So far behind, polishing may still bring a candidate in front.
constexpr double within_reach_of_polish = 30.0;
constexpr int screening_iterations = 3;
/// Where an effect of the motion gains so much, the noise beside it is another.
constexpr double much = 100.0;
/// Of an effect's guesses, so many are fitted a little, and so many to the end.
constexpr std::size_t guesses_screened = 8, guesses_fitted = 2;

/// The first `count` of `guesses`, by what `score` says of each.
template <typename Score>
std::vector<Effect> likeliest(const std::vector<Effect>& guesses, std::size_t count,
                              const Score& score) {
  if (guesses.size() <= count) return guesses;
  std::vector<std::pair<double, std::size_t>> ranks;
  for (std::size_t k = 0; k < guesses.size(); ++k) ranks.emplace_back(score(guesses[k]), k);
  std::sort(ranks.rbegin(), ranks.rend());
  std::vector<Effect> first;
  for (std::size_t k = 0; k < count; ++k) first.push_back(guesses[ranks[k].second]);
  return first;
}

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

Standing SetBench::with(const Standing& standing, const CauseType& cause,
                        const Evidence* left) const {
  if (cause.guesses != nullptr) return with_guessed(standing, cause);
  if (left == nullptr || !is_taken_out(cause.effect())) return {};
  return with_started(standing, cause, *left);
}

Standing SetBench::with_guessed(const Standing& standing, const CauseType& cause) const {
  const Beside beside{conditions_, *standing.fitter, standing.fit};
  // The walk that stands in for jumps of the set takes up whatever is slow, so beside a slow
  // effect they are followed; of a fast one, what was screened without them is not taken over.
  const bool jumps = law_of(standing.scenario, conditions_.interval_s()).jumps.has_value();
  const bool slow = is_slow(cause.id);
  // What the others took up of an effect that went, they give back: begun as they were beside it,
  // too, or with a smaller walk.
  std::vector<Scenario> starts = {standing.scenario};
  if (!slow && standing.beside_the_last)
    starts.push_back(*standing.beside_the_last);
  else if (!(jumps && slow))  // beside them it is small, and they take long
    starts.push_back(with_walk_times(standing.scenario, 0.1));
  const auto begun = [&](Scenario start, const Effect& guess, int iterations) {
    start.effects.push_back(guess);
    return fitted(standing.fitter->with_white_noise_scaled(std::move(start)), standing.fitter,
                  iterations, jumps && slow ? Jumping::yes : Jumping::no);
  };
  const auto log_likelihood = [&](const Effect& guess) {
    double most = -1e300;
    for (const auto& start : starts)
      most = std::max(most, begun(start, guess, 0).fit.log_likelihood);
    return most;
  };
  std::vector<Standing> screened;
  for (const auto& guess : likeliest(cause.guesses(beside), guesses_screened, log_likelihood)) {
    screened.emplace_back();
    for (const auto& start : starts)
      if (auto tried = begun(start, guess, screening_iterations);
          tried.score > screened.back().score)
        screened.back() = std::move(tried);
  }
  std::stable_sort(screened.begin(), screened.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  Standing best;
  for (std::size_t k = 0; k < std::min(guesses_fitted, screened.size()); ++k) {
    if (screened[k].score < -1e299) continue;
    Scenario start = screened[k].scenario;
    if (jumps && !slow) {
      for (std::size_t e = 0; e < standing.scenario.effects.size(); ++e)
        if (is_slow(start.effects[e].id())) start.effects[e] = standing.scenario.effects[e];
      const double white = start.random_error.measurement_noise_std_dps;
      start.random_error = standing.scenario.random_error;
      start.random_error.measurement_noise_std_dps = white;
    }
    if (auto tried = fitted(start, standing.fitter, fitting_iterations); tried.score > best.score)
      best = std::move(tried);
  }
  return best;
}

Standing SetBench::with_started(const Standing& standing, const CauseType& cause,
                                const Evidence& left) const {
  Standing best;
  const auto keep = [&](Standing candidate) {
    if (candidate.score > best.score) best = std::move(candidate);
  };
  // Starts of a motion's effect are forms of it: which is the likelier is seen when each fits. A
  // line's are its maxima already.
  const bool are_forms = band_of(cause.id) == EffectBand::motion;
  for (const auto& start : cause.starts(left)) {
    Scenario scenario = standing.scenario;
    scenario.effects.push_back(start);
    auto tried = refitted(scenario, 6);
    // The walk that stood in for a motion is more than the noise, and a fit may end beside it.
    if (are_forms && tried.score > standing.score + much)
      if (auto anew = beside_noise(scenario.effects); anew.score > tried.score)
        tried = std::move(anew);
    if (are_forms && tried.score > standing.score - within_reach_of_polish) keep(polished(tried));
    keep(std::move(tried));
  }
  return best;
}

/// What is written as 0 says no more of its zone than its edge.
bool SetBench::is_read_off(const Effect& effect) const {
  return marked_dead_zone_ && effect.id() == "dead_zone" &&
         effect.value(field_of(effect, "lost_beyond")) == 0.0;
}

Standing SetBench::polished(Standing standing) const {
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
  }
  return refitted(scenario, 8);
}

}  // namespace gyrostat::gap
