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
constexpr double most_odds = 1e4;

EffectBand band_of_last(const Standing& standing) {
  return band_of(standing.scenario.effects.back().id());
}

/// A sensor has lines as it has them; every other effect is there once.
bool may_repeat(const Scenario& scenario, std::string_view effect) {
  constexpr std::ptrdiff_t most_lines = 3;
  return effect == "vibration" &&
         std::count_if(scenario.effects.begin(), scenario.effects.end(),
                       [&](const auto& e) { return e.id() == effect; }) < most_lines;
}

}  // namespace

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
  return share_of_band * std::max(of_band, of_motion);
}

Standing SetSearcher::two_further(const Standing& standing, std::vector<Standing> tried) {
  constexpr double nearly_pays = 6.0;
  constexpr std::size_t most_tried = 3;
  std::erase_if(tried, [&](const Standing& t) {
    return t.score < standing.score - nearly_pays || !is_slow(t.scenario.effects.back().id());
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

Standing SetSearcher::searched(Standing standing) {
  for (std::size_t step = 0; step < 2 * options_.most_effects; ++step) {
    if (standing.scenario.effects.size() >= options_.most_effects + 2) break;
    auto tried = each_added(standing);
    const auto best = std::max_element(
        tried.begin(), tried.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
    for (const auto& t : tried)
      if (t.score > -1e299)
        screening_.emplace_back(t.scenario.effects.back().id(), t.score - standing.score);
    if (best == tried.end() || best->score < -1e299) break;
    const bool pays = best->score > standing.score + least_gain(standing, band_of_last(*best));
    auto next = pays ? *best : two_further(standing, std::move(tried));
    if (next.score <= standing.score) break;
    gains_.emplace_back(next.scenario.effects.back().id(), next.score - standing.score);
    standing = std::move(next);
    tell(fmt::format("beside {}", standing.scenario.effects.back().id()),
         standing.scenario.effects.size() + 2);
    // What the newcomer made needless goes.
    for (bool dropped = true; dropped;) {
      dropped = false;
      for (std::size_t k = 0; k < standing.scenario.effects.size(); ++k) {
        if (bench_.is_marked(standing.scenario.effects[k].id())) continue;
        auto rest = bench_.without(standing, k);
        if (rest.score > standing.score) {
          standing = std::move(rest);
          dropped = true;
          break;
        }
      }
    }
    // What was fitted beside less has moved.
    if (auto fit = bench_.polished(standing); fit.score > standing.score) standing = std::move(fit);
  }
  return standing;
}

Standing SetSearcher::exchanged(Standing standing, FoundSet& found) {
  std::size_t exchanges = 0;
  for (bool swapped = true; swapped;) {
    swapped = false;
    found.rivals.clear();
    for (std::size_t k = 0; k < standing.scenario.effects.size(); ++k) {
      const Effect effect = standing.scenario.effects[k];
      if (bench_.is_marked(effect.id())) continue;
      tell(fmt::format("rivals of {}", effect.id()), standing.scenario.effects.size() - k);
      const auto rest = bench_.without(standing, k);
      // The same effect from other parameters may stand there, too, but is no rival; nor are names
      // of a line.
      const auto is_the_same = [&](const Standing& other) {
        const auto id = other.scenario.effects.back().id();
        return id == effect.id() || (is_line(id) && is_line(effect.id()));
      };
      const auto others = each_added(rest);
      double second = rest.score;
      const Standing* best = &rest;
      for (const auto& other : others) {
        if (other.score > best->score) best = &other;
        if (other.score < -1e299 || is_the_same(other)) continue;
        second = std::max(second, other.score);
        if (other.score > standing.score - 3.0)
          found.rivals.push_back({other.scenario.effects.back(),
                                  std::string(other.scenario.effects.back().id()),
                                  std::string(effect.id()), other.score - standing.score});
      }
      // From other parameters, what the others are worth beside it is as before.
      constexpr double little = 3.0;
      if (best != &rest && is_the_same(*best) && best->score > standing.score &&
          best->score < standing.score + little) {
        standing = *best;
        auto& effects = standing.scenario.effects;
        std::rotate(effects.begin() + static_cast<std::ptrdiff_t>(k), effects.end() - 1,
                    effects.end());
        standing.fit.scenario.effects = effects;
        best = &rest;
      }
      if (best->score > standing.score + 0.1) {
        standing = searched(*best);
        swapped = ++exchanges < 2 * options_.most_effects;
        break;
      }
      const std::string name(standing.scenario.effects[k].id());
      const auto known = std::find_if(found.members.begin(), found.members.end(),
                                      [&](const auto& m) { return m.effect == name; });
      const double odds = std::min(standing.score - second, most_odds);
      if (known == found.members.end())
        found.members.push_back({name, odds});
      else
        known->log_odds = std::max(known->log_odds, odds);
    }
    if (swapped)
      found.members.erase(
          std::remove_if(found.members.begin(), found.members.end(),
                         [&](const auto& m) { return !bench_.is_marked(m.effect); }),
          found.members.end());
  }
  return standing;
}

}  // namespace gyrostat::gap
