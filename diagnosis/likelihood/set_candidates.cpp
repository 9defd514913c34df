#include <gyrostat/diagnosis/likelihood/set_bench.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include <tbb/parallel_for.h>

#include <gyrostat/diagnosis/catalogue/dead_zone.hpp>
#include <gyrostat/diagnosis/catalogue/saturation.hpp>
#include <gyrostat/diagnosis/likelihood/beside.hpp>
#include <gyrostat/diagnosis/likelihood/dials.hpp>
#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/motion_left.hpp>

namespace gyrostat::gap {
namespace {

/// So far behind, polishing may still bring a candidate in front.
constexpr double within_reach_of_polish = 30.0;
/// No further behind what it is added to, a candidate may be a rival of what was taken away.
constexpr double furthest_rival = 3.0;
constexpr int screening_iterations = 3;
/// Where an effect of the motion gains so much, the noise beside it is another.
constexpr double much = 100.0;
/// Of an effect's guesses, so many are fitted a little, and so many to the end.
constexpr std::size_t guesses_screened = 8, guesses_fitted = 2;

/// An effect as it may be, and what fits it beside the others.
struct Guess {
  Effect effect;
  std::shared_ptr<const SetFitter> fitter;
};

/// The first `count` of `guesses`, by what `score` says of each.
template <typename Score>
std::vector<Guess> likeliest(const std::vector<Guess>& guesses, std::size_t count,
                             const Score& score) {
  if (guesses.size() <= count) return guesses;
  std::vector<std::pair<double, std::size_t>> ranks;
  for (std::size_t k = 0; k < guesses.size(); ++k) ranks.emplace_back(score(guesses[k]), k);
  std::sort(ranks.rbegin(), ranks.rend());
  std::vector<Guess> first;
  for (std::size_t k = 0; k < count; ++k) first.push_back(guesses[ranks[k].second]);
  return first;
}

/// What a further effect is put beside: to a filter of the rate a limit of the element or a dead
/// zone may also be on its other side.
std::vector<Scenario> sides_of(const CauseType& cause, const Scenario& beside) {
  std::vector<Scenario> sides = {beside};
  if (cause.id != "sensor_bandwidth") return sides;
  const auto put_across = [&](std::size_t k, const auto& effect) {
    using E = std::decay_t<decltype(effect)>;
    if (effect.response() == Response::none) return;
    sides.push_back(beside);
    sides.back().effects[k] = Diagnosed<E>::across_a_filter(effect);
  };
  for (std::size_t k = 0; k < beside.effects.size(); ++k) {
    if (const auto* limit = beside.effects[k].as<effects::Saturation>()) put_across(k, *limit);
    if (const auto* zone = beside.effects[k].as<effects::DeadZone>()) put_across(k, *zone);
  }
  return sides;
}

}  // namespace

Standing SetBench::with(const Standing& standing, const CauseType& cause,
                        const Evidence* left) const {
  if (cause.guesses != nullptr) return with_guessed(standing, cause);
  if (left == nullptr || !is_taken_out(cause.effect())) return {};
  return with_started(standing, cause, *left);
}

Standing SetBench::with_guessed(const Standing& standing, const CauseType& cause) const {
  constexpr double clearly = 10.0;
  const bool is_moved =
      is_line(cause.id) && conditions_.has_motion() &&
      log_gain_of_motion(conditions_, rate_left_by(standing.scenario, masked())) > clearly;
  const Beside beside{conditions_, *standing.fitter, standing.fit, is_moved};
  // The walk that stands in for jumps of the set takes up whatever is slow, so beside a slow
  // effect they are followed; of a fast one, what was screened without them is not taken over.
  const bool jumps = law_of(standing.scenario, conditions_.interval_s()).jumps.has_value();
  const bool slow = is_slow(cause.id);
  // What the others took up of an effect that went, they give back: begun as they were beside it,
  // too, and with a smaller walk.
  std::vector<Scenario> starts = {standing.scenario};
  if (!slow && standing.beside_the_last) starts.push_back(*standing.beside_the_last);
  if (!(jumps && slow))  // beside them it is small, and they take long
    starts.push_back(with_walk_times(standing.scenario, 0.1));
  // What samples within clusters know of an effect is taken out of them.
  std::vector<Guess> guesses;
  for (const auto& effect : cause.guesses(beside)) {
    guesses.push_back({effect, standing.fitter});
    const auto sized = sized_within(standing, effect);
    if (!sized) continue;
    Scenario with = standing.scenario;
    with.effects.push_back(*sized);
    if (auto fitter = fitter_of(with)) guesses.push_back({*sized, std::move(fitter)});
  }
  const auto begun = [&](Scenario start, const Guess& guess, int iterations) {
    start.effects.push_back(guess.effect);
    return fitted(guess.fitter->with_white_noise_scaled(std::move(start)), guess.fitter, iterations,
                  jumps && slow ? Jumping::yes : Jumping::no);
  };
  const auto log_likelihood = [&](const Guess& guess) {
    double most = -1e300;
    for (const auto& start : starts)
      most = std::max(most, begun(start, guess, 0).fit.log_likelihood);
    return most;
  };
  std::vector<Standing> screened;
  for (const auto& guess : likeliest(guesses, guesses_screened, log_likelihood)) {
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
    if (auto tried = fitted(start, screened[k].fitter, fitting_iterations);
        tried.score > best.score)
      best = std::move(tried);
  }
  return best;
}

Standing SetBench::with_started(const Standing& standing, const CauseType& cause,
                                const Evidence& left) const {
  // Starts of a motion's effect are forms of it: which is the likelier is seen when each fits. A
  // line's are its maxima already.
  const bool are_forms = band_of(cause.id) == EffectBand::motion;
  const auto starts = cause.starts(left);
  const auto sides = sides_of(cause, standing.scenario);
  std::vector<Standing> fits(sides.size() * starts.size());
  tbb::parallel_for(std::size_t{0}, fits.size(), [&](std::size_t k) {
    Scenario scenario = sides[k / starts.size()];
    scenario.effects.push_back(starts[k % starts.size()]);
    auto tried = refitted(scenario, 6);
    // The walk that stood in for a motion is more than the noise, and a fit may end beside it.
    if (are_forms && tried.score > standing.score + much)
      if (auto anew = beside_noise(scenario.effects); anew.score > tried.score)
        tried = std::move(anew);
    if (are_forms && tried.score > standing.score - within_reach_of_polish)
      if (auto fit = polished(tried, standing.score - furthest_rival); fit.score >= tried.score)
        tried = std::move(fit);
    fits[k] = std::move(tried);
  });
  Standing best;
  for (auto& fit : fits)
    if (fit.score > best.score) best = std::move(fit);
  return best;
}

}  // namespace gyrostat::gap
