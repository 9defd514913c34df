#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace gyrostat::gap {
namespace {

constexpr double most_odds = 1e4;

/// A curve that is nearly as likely as the slow noise in whose place it stands, the likeliest:
/// beside another one it may be likelier. nullptr: there is none.
const Standing* curve_for(const Standing& standing, const Effect& noise,
                          const std::vector<Standing>& others) {
  constexpr double nearly = 15.0;
  if (band_of(noise.id()) != EffectBand::slow ||
      cause_types().named(noise.id(), "effects").signature != Signature::none)
    return nullptr;
  const Standing* best = nullptr;
  for (const auto& other : others) {
    if (other.score <= (best == nullptr ? standing.score - nearly : best->score)) continue;
    const auto id = other.scenario.effects.back().id();
    if (cause_types().named(id, "effects").signature == Signature::slow) best = &other;
  }
  return best;
}

}  // namespace

Standing SetSearcher::fitted_to_the_end(Standing rival, double to_reach) const {
  if (auto fit = bench_.polished(bench_.refitted(rival.scenario)); fit.score > rival.score)
    rival = std::move(fit);
  for (std::size_t k = 0; k < rival.scenario.effects.size(); ++k)
    if (is_noise_filter(rival.scenario.effects[k].id()))
      rival = bench_.told_otherwise(rival, k, to_reach);
  return rival;
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
      // What the response lacks was found beside this effect, not beside its rivals, and where it
      // is not known it shows.
      const auto response = bench_.response();
      const auto masked = bench_.masked();
      const Standing as_it_was = standing;
      const bool is_bare = is_of_response(effect.id()) && (response || hides_response());
      if (is_bare) {
        bench_.take_out_response(std::nullopt);
        if (hides_response()) bench_.mask_only(hidden_from_response_);
        standing = bench_.refitted(standing.scenario);
      }
      const auto put_back = [&] {
        bench_.take_out_response(response);
        bench_.mask_only(masked);
        standing = as_it_was;
      };
      const auto rest = bench_.without(standing, k);
      // The same effect from other parameters may stand there, too, but is no rival; nor are names
      // of a line.
      const auto is_the_same = [&](const Standing& other) {
        const auto id = other.scenario.effects.back().id();
        return id == effect.id() || (is_line(id) && is_line(effect.id()));
      };
      auto others = each_added(rest);
      // What has moved without it has moved for its rivals as for itself, put there anew.
      constexpr double moved = 10.0;
      double anew = standing.score;
      for (const auto& other : others)
        if (other.score > standing.score - moved && is_the_same(other))
          anew = std::min(anew, other.score);
      // One that is likelier than that is fitted to the end, and is held against what stands; so is
      // a filter, of whose many forms one must be clearly likelier.
      constexpr double within_reach = 30.0, clearly = 3.0;
      std::vector<double> against(others.size(), anew);
      for (std::size_t o = 0; o < others.size(); ++o) {
        if (others[o].score < -1e299 || is_the_same(others[o])) continue;
        const bool is_likelier = others[o].score > anew;
        const bool is_another_filter = is_noise_filter(effect.id()) &&
                                       is_noise_filter(others[o].scenario.effects.back().id()) &&
                                       others[o].score > standing.score - within_reach;
        if (!is_likelier && !is_another_filter) continue;
        auto fit = fitted_to_the_end(others[o], standing.score);
        if (!is_likelier && fit.score < standing.score + clearly) continue;
        others[o] = std::move(fit);
        against[o] = standing.score;
      }
      // Its rivals may yet give the others their names back.
      const auto called = bench_.as_called(rest);
      double least_lost = standing.score - called.score;
      const Standing* best = &called;
      for (std::size_t o = 0; o < others.size(); ++o) {
        const auto& other = others[o];
        if (other.score > best->score) best = &other;
        if (other.score < -1e299 || is_the_same(other)) continue;
        const double ahead = other.score - against[o];
        least_lost = std::min(least_lost, -ahead);
        if (ahead > -3.0)
          found.rivals.push_back({other.scenario.effects.back(),
                                  std::string(other.scenario.effects.back().id()),
                                  std::string(effect.id()), ahead});
      }
      // From other parameters, what the others are worth beside it is as before.
      constexpr double more = 0.1, little = 3.0;
      if (!is_bare && best != &called && is_the_same(*best) &&
          best->score > standing.score + more && best->score < standing.score + little) {
        standing = *best;
        auto& effects = standing.scenario.effects;
        std::rotate(effects.begin() + static_cast<std::ptrdiff_t>(k), effects.end() - 1,
                    effects.end());
        standing.fit.scenario.effects = effects;
        best = &called;
      }
      const bool is_better = best->score > standing.score + more;
      if (const auto* curve = is_better ? nullptr : curve_for(standing, effect, others)) {
        if (auto several = searched(*curve); several.score > standing.score + more) {
          standing = std::move(several);
          swapped = ++exchanges < 2 * options_.most_effects;
          break;
        }
        put_back();
      }
      if (is_better) {
        standing = searched(*best);
        // A name is worth what a response without one has to gain.
        const double least =
            as_it_was.score - (response && !bench_.response() ? clear_response : 0.0);
        if (is_bare && masked == bench_.masked() && standing.score < least) {
          put_back();
          continue;
        }
        swapped = ++exchanges < 2 * options_.most_effects;
        break;
      }
      const std::string name(standing.scenario.effects[k].id());
      const auto known = std::find_if(found.members.begin(), found.members.end(),
                                      [&](const auto& m) { return m.effect == name; });
      const double odds = std::min(least_lost, most_odds);
      if (known == found.members.end())
        found.members.push_back({name, odds});
      else
        known->log_odds = std::max(known->log_odds, odds);
      if (is_bare) put_back();
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
