#include <algorithm>

#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

namespace gyrostat::gap {
namespace {

bool is_of(const Effect& effect, std::string_view part) {
  const auto* cause = cause_types().find(effect.id());
  return cause != nullptr && cause->part == part;
}

std::vector<std::string> names_of(const std::vector<Effect>& effects) {
  std::vector<std::string> names;
  for (const auto& effect : effects) names.emplace_back(effect.id());
  return names;
}

}  // namespace

Scenario SetSearcher::end_with(std::string_view part, const std::vector<Effect>& effects,
                               Scenario end) {
  std::erase_if(end.effects, [&](const auto& effect) { return is_of(effect, part); });
  end.effects.insert(end.effects.end(), effects.begin(), effects.end());
  return end;
}

Standing SetSearcher::refitted_from_either(const Scenario& scenario) const {
  auto fit = bench_.refitted(scenario);
  auto other = bench_.refitted(end_->fitter->with_white_noise_scaled(scenario));
  return other.score > fit.score ? other : fit;
}

std::optional<Worth> SetSearcher::worth_with(std::string_view part,
                                             const std::vector<Effect>& effects) {
  if (!end_ || std::any_of(effects.begin(), effects.end(),
                           [&](const auto& effect) { return !bench_.is_allowed(effect.id()); }))
    return {};
  bench_.mask_only(masked_);
  bench_.take_out_response(response_);
  const auto before = bench_.given();
  bench_.give(names_of(effects));
  auto fit = refitted_from_either(end_with(part, effects, end_->scenario));
  if (effects.empty())
    for (std::size_t k = 0; k < end_->scenario.effects.size(); ++k)
      if (is_of(end_->scenario.effects[k], part))
        if (auto rest = bench_.without(*end_, k);
            rest.score > fit.score && rest.scenario.effects.size() == fit.scenario.effects.size())
          fit = std::move(rest);
  const double given = bench_.price_of(fit.scenario);
  bench_.give(before);
  if (fit.score < -1e299) return {};
  return Worth{fit.score, bench_.price_of(fit.scenario) - given};
}

FoundSet SetSearcher::beside(const std::vector<Given>& given) {
  bench_.mask_only(masked_);
  bench_.take_out_response(response_);
  std::vector<Effect> effects;
  for (const auto& g : given) effects.push_back(g.effect);
  const auto names = names_of(effects);
  const auto is_given = [&](const std::string& effect) {
    return std::find(names.begin(), names.end(), effect) != names.end();
  };
  Scenario scenario = end_->scenario;
  for (const auto& g : given)
    scenario =
        end_with(cause_types().named(g.effect.id(), "effects").part, {}, std::move(scenario));
  scenario.effects.insert(scenario.effects.end(), effects.begin(), effects.end());
  const auto is_same = [](const Effect& a, const Effect& b) { return a.id() == b.id(); };
  const bool is_as_found =
      std::is_permutation(scenario.effects.begin(), scenario.effects.end(),
                          end_->scenario.effects.begin(), end_->scenario.effects.end(), is_same);
  bench_.give(names);
  auto standing = refitted_from_either(scenario);
  FoundSet found{.baseline = searched_.baseline, .scenario = {}, .members = searched_.members};
  if (is_as_found) {
    std::erase_if(found.members, [&](const auto& m) { return is_given(m.effect); });
    found.rivals = searched_.rivals;
    std::erase_if(found.rivals, [&](const auto& r) { return is_given(r.instead_of); });
  } else {
    std::erase_if(found.members, [](const auto& m) { return !m.read_off; });
    standing = concluded(searched_beside_tails(std::move(standing)), found);
  }
  for (const auto& g : given) {
    found.members.push_back({.effect = std::string(g.effect.id()),
                             .log_odds = g.log_odds,
                             .given = true,
                             .p_equal = g.p_equal});
    found.rivals.insert(found.rivals.end(), g.rivals.begin(), g.rivals.end());
  }
  found = described(std::move(standing), std::move(found));
  for (const auto& g : given) {
    const auto& all = found.scenario.effects;
    const auto place = static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(),
                     [&](const auto& effect) { return effect.id() == g.effect.id(); }) -
        all.begin());
    std::erase_if(found.intervals, [&](const auto& interval) {
      return interval.effect == place && is_alike(g.effect, interval.field);
    });
    for (std::size_t field = 0; field < g.intervals.size(); ++field)
      if (const auto [low, high] = g.intervals[field]; low == low)
        found.intervals.push_back({place, field, low, high});
  }
  return found;
}

}  // namespace gyrostat::gap
