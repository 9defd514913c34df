#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

#include <algorithm>
#include <atomic>
#include <thread>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <gyrostat/diagnosis/likelihood/motion_left.hpp>

namespace gyrostat::gap {
namespace {

/// A further effect of the same band gains this share of what the band's clearest does: nature's
/// form of an effect and ours differ by as much.
constexpr double share_of_band = 0.003;

/// A sensor has lines as it has them; every other effect is there once.
bool may_repeat(const Scenario& scenario, std::string_view effect) {
  constexpr std::ptrdiff_t most_lines = 3;
  return (effect == "vibration" || effect == "sinusoidal") &&
         std::count_if(scenario.effects.begin(), scenario.effects.end(),
                       [&](const auto& e) { return e.id() == effect; }) < most_lines;
}

}  // namespace

EffectBand SetSearcher::band_of_last(const Standing& standing) const {
  return band_of(standing.scenario.effects.back(), conditions_);
}

std::vector<Standing> SetSearcher::each_added(const Standing& standing) {
  std::vector<Standing> all(candidates_.size());
  std::atomic<std::size_t> tried{0};
  const auto caller = std::this_thread::get_id();
  const auto try_those = [&](bool with_guesses, const Evidence* left) {
    tbb::parallel_for(
        std::size_t{0}, candidates_.size(),
        [&](std::size_t k) {
          const auto& cause = *candidates_[k];
          if ((cause.guesses != nullptr) != with_guesses) return;
          if (!has(standing.scenario, cause.id) || may_repeat(standing.scenario, cause.id))
            all[k] = bench_.with(standing, cause, left);
          const auto done = static_cast<double>(++tried);
          if (std::this_thread::get_id() == caller)
            tell_share(done / static_cast<double>(candidates_.size()));
        },
        tbb::simple_partitioner());
  };
  // Guesses need no evidence, and are tried while it is made for the others.
  tbb::parallel_invoke(
      [&] {
        if (std::all_of(candidates_.begin(), candidates_.end(),
                        [](const auto* cause) { return cause->guesses != nullptr; }))
          return;
        const auto left = bench_.evidence_of(standing);
        try_those(false, &left);
      },
      [&] { try_those(true, nullptr); });
  ++rounds_;
  return all;
}

double SetSearcher::least_gain(const Standing& standing, EffectBand band) const {
  double of_band = 0.0, of_motion = 0.0;
  for (const auto& [effect, gain] : gains_) {
    if (!has(standing.scenario, effect)) continue;
    auto& most = band_of(effect) == EffectBand::motion ? of_motion : of_band;
    if (band_of(effect) == band || band_of(effect) == EffectBand::motion)
      most = std::max(most, gain);
  }
  // Where nothing of the motion is left, its effects have nature's form.
  if (band != EffectBand::motion && of_motion > of_band)
    of_motion = std::min(
        of_motion,
        std::max(0.0, log_gain_of_motion(conditions_,
                                         bench_.rate_left_by(standing.scenario, bench_.masked()))) /
            share_of_band);
  return std::max(share_of_band * std::max(of_band, of_motion),
                  band == EffectBand::fast ? feigned_colour_ : 0.0);
}

double SetSearcher::least_gain(const Standing& standing, const Standing& with) const {
  constexpr double clear = 10.0;
  const auto band = band_of_last(with);
  const double least = least_gain(standing, band);
  const double gain = with.score - standing.score;
  if (band != EffectBand::motion || gain < clear || gain > least) return least;
  // Nor has what it leaves nothing of.
  return std::min(
      least, std::max(clear, log_gain_of_motion(conditions_, bench_.rate_left_by(
                                                                 with.scenario, bench_.masked()))));
}

Standing SetSearcher::two_further(const Standing& standing, std::vector<Standing> tried) {
  // What gains nothing by itself has gone to nothing, and a pair with it is the other alone.
  constexpr double nearly_pays = 6.0, nothing = 1.0;
  constexpr std::size_t most_tried = 3;
  std::erase_if(tried, [&](const Standing& t) {
    if (t.fit.log_likelihood < standing.fit.log_likelihood + nothing) return true;
    // Beside jumps whatever is slow takes long; a pair with one is begun from the other.
    return t.score < standing.score - nearly_pays || !is_slow(t.scenario.effects.back().id()) ||
           law_of(t.scenario, conditions_.interval_s()).jumps.has_value();
  });
  std::stable_sort(tried.begin(), tried.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  if (tried.size() > most_tried) tried.resize(most_tried);
  const auto all = candidates_;
  std::erase_if(candidates_, [](const auto* cause) { return !is_slow(cause->id); });
  Standing best = standing;
  for (const auto& t : tried)
    for (auto& further : each_added(t))
      if (further.score > best.score &&
          further.score > standing.score + least_gain(t, band_of_last(further)))
        best = std::move(further);
  candidates_ = all;
  return best;
}

Standing SetSearcher::beside_response(Standing standing) {
  const auto known = bench_.response();
  bench_.take_out_response(std::nullopt);
  const auto found = response_left(bench_, standing.scenario);
  if (!known && !found) return standing;
  const auto plain = known ? bench_.refitted(standing.scenario) : standing;
  if (!found) return plain;
  bench_.take_out_response(found);
  if (auto fit = bench_.refitted(standing.scenario); fit.score > plain.score + clear_response)
    return fit;
  bench_.take_out_response(std::nullopt);
  return plain;
}

/// What the motion does is repeated by every replica: noise must not stand in for it.
std::vector<Standing>::const_iterator SetSearcher::foremost(
    const Standing& standing, const std::vector<Standing>& tried) const {
  constexpr double clear = 10.0, least_score = -1e299;
  auto best = tried.end();
  bool moves = false;
  for (auto t = tried.begin(); t != tried.end(); ++t) {
    if (t->score < least_score) continue;
    const bool also_moves = band_of_last(*t) == EffectBand::motion &&
                            t->score > standing.score + std::max(clear, least_gain(standing, *t));
    if (best == tried.end() || (also_moves && !moves) ||
        (also_moves == moves && t->score > best->score)) {
      best = t;
      moves = also_moves;
    }
  }
  return best;
}

/// What the newcomer made needless goes, and what was fitted beside less has moved.
Standing SetSearcher::settled(Standing standing) const {
  for (bool dropped = true; dropped;) {
    dropped = false;
    for (std::size_t k = 0; k < standing.scenario.effects.size(); ++k) {
      const auto id = standing.scenario.effects[k].id();
      if (bench_.is_marked(id) || (is_of_response(id) && hides_response())) continue;
      auto rest = bench_.without(standing, k);
      if (rest.score > standing.score) {
        standing = std::move(rest);
        dropped = true;
        break;
      }
    }
  }
  if (auto fit = bench_.polished(standing); fit.score > standing.score) standing = std::move(fit);
  if (standing.scenario.effects.empty()) return standing;
  const auto band = band_of_last(standing);
  for (std::size_t k = 0; k < standing.scenario.effects.size(); ++k) {
    const auto id = standing.scenario.effects[k].id();
    const bool is_last = k + 1 == standing.scenario.effects.size();
    if (band == EffectBand::motion
            ? (is_of_response(id) || id == "saturation" || id == "dead_zone") && !is_last
            : band == EffectBand::fast && is_noise_filter(id))
      standing = bench_.told_otherwise(standing, k);
  }
  return standing;
}

Standing SetSearcher::searched(Standing standing) {
  bool motion_has_changed = true;
  for (std::size_t step = 0; step < 2 * options_.most_effects; ++step) {
    if (standing.scenario.effects.size() >= options_.most_effects + 2) break;
    auto tried = each_added(standing);
    for (const auto& t : tried)
      if (t.score > -1e299)
        screening_.emplace_back(t.scenario.effects.back().id(), t.score - standing.score);
    const auto best = foremost(standing, tried);
    if (best == tried.end()) break;
    // When no more is to be had of the motion that has a name, what it lacks must not pass for
    // noise.
    if (motion_has_changed && band_of_last(*best) != EffectBand::motion) {
      motion_has_changed = false;
      const double before = standing.score;
      standing = beside_response(std::move(standing));
      if (standing.score != before) continue;
    }
    const bool pays = best->score > standing.score + least_gain(standing, *best);
    auto next = pays ? *best : two_further(standing, std::move(tried));
    if (next.score <= standing.score) break;
    motion_has_changed |= band_of_last(next) == EffectBand::motion;
    gains_.emplace_back(next.scenario.effects.back().id(), next.score - standing.score);
    standing = std::move(next);
    tell(fmt::format("beside {}", standing.scenario.effects.back().id()),
         standing.scenario.effects.size() + 2);
    standing = settled(std::move(standing));
  }
  return standing;
}

}  // namespace gyrostat::gap
