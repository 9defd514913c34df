#include <gyrostat/diagnosis/remainder/remainder.hpp>

#include <algorithm>

#include <gyrostat/diagnosis/likelihood/nameless_mean.hpp>
#include <gyrostat/diagnosis/remainder/compass_tails.hpp>
#include <gyrostat/diagnosis/remainder/distribution.hpp>
#include <gyrostat/diagnosis/remainder/filter.hpp>
#include <gyrostat/diagnosis/remainder/noise_over_rate.hpp>
#include <gyrostat/diagnosis/remainder/wander.hpp>

namespace gyrostat::gap {

std::vector<Nameless> without_needless_means(std::vector<Nameless> parts,
                                             const ScoreOfParts& score_of) {
  for (std::size_t k = parts.size(); k-- > 0;) {
    if (!is_mean_without_name(parts[k].effect)) continue;
    auto others = parts;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    if (score_of(others) >= score_of(parts)) parts = std::move(others);
  }
  return parts;
}

std::vector<Nameless> with_what_replicas_lack(const Simulator& simulator, const Series& recording,
                                              const Scenario& set, std::vector<Nameless> parts,
                                              const ScoreOfParts& score_of) {
  const auto& conditions = simulator.conditions();
  const auto replicated_with = [&](const std::vector<Nameless>& some) {
    return Replicated(simulator, recording, with_nameless(set, some));
  };
  double score = score_of(parts);
  const auto add = [&](const std::optional<Nameless>& part) {
    if (!part) return false;
    auto more = parts;
    // There is one noise of the compass.
    const auto same = std::find_if(more.begin(), more.end(), [&](const Nameless& other) {
      return other.effect.id() == part->effect.id();
    });
    if (same == more.end())
      more.push_back(*part);
    else
      *same = {part->effect, same->in_words + ", with " + part->in_words};
    const double with = score_of(more);
    if (with <= score) return false;
    score = with;
    parts = std::move(more);
    return true;
  };
  const auto first = replicated_with(parts);
  bool changed = add(rate_wander_part(conditions, first));
  changed |= add(noise_over_rate_part(conditions, first));
  add(compass_wander_part(conditions, first));
  add(compass_tails_part(conditions, first, with_nameless(set, parts)));

  // Heavy tails make a spectrum uncertain, so a filter is estimated beside their map; it makes them
  // lighter, so they are estimated again behind it.
  const auto beside = changed ? replicated_with(parts) : first;
  const auto tails = distribution_part(beside);
  auto with_tails = parts;
  if (tails) with_tails.push_back(*tails);
  if (add(filter_part(tails ? replicated_with(with_tails) : beside, conditions.rate_hz())))
    add(distribution_part(replicated_with(parts)));
  else
    add(tails);
  return parts;
}

}  // namespace gyrostat::gap
