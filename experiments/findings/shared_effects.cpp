#include <gyrostat/experiments/findings/shared_effects.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/analysis/statistics/random_effects.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/experiments/study/fleet.hpp>

namespace gyrostat::gap {
namespace {

SharedParameter over_members(const std::vector<MemberValue>& all, const Effect& of,
                             std::size_t field) {
  const auto& described = of.fields()[field];
  SharedParameter p{.name = std::string(described.name),
                    .unit = std::string(described.unit),
                    .mean = 0.0,
                    .mean_low = no_value,
                    .mean_high = no_value,
                    .spread = no_value,
                    .spread_low = no_value,
                    .spread_high = no_value,
                    .p_equal = no_value};
  const auto n = static_cast<double>(all.size());
  if (std::any_of(all.begin(), all.end(), [](const auto& k) { return !(k.error > 0.0); })) {
    for (const auto& k : all) p.mean += k.value / n;
    double squares = 0.0;
    for (const auto& k : all) squares += (k.value - p.mean) * (k.value - p.mean);
    p.spread = std::sqrt(squares / (n - 1.0));
    constexpr double last_digits = 1e-12;
    if (p.spread < last_digits * std::abs(p.mean)) p.spread = 0.0;
    return p;
  }
  const double degrees = n - 1.0;
  p.p_equal = chi_squared_upper_tail(q_between(all, 0.0), degrees);
  p.spread_low = spread_at(all, chi_squared_upper_quantile(0.025, degrees));
  p.spread_high = spread_at(all, chi_squared_quantile(0.025, degrees));
  const auto population = random_effects(all);
  p.spread = population.spread;
  p.mean = population.mean;
  const double reach = student_t_two_sided(0.95, degrees) * population.mean_error;
  p.mean_low = p.mean - reach;
  p.mean_high = p.mean + reach;
  return p;
}

const Included* found_in(const FleetMember& member, const std::string& effect) {
  const auto& effects = member.diagnosis.effects;
  const auto at = std::find_if(effects.begin(), effects.end(),
                               [&](const auto& e) { return e.effect == effect; });
  return at == effects.end() || at->parameters.empty() ? nullptr : &*at;
}

bool is_fitted_once(const std::vector<std::pair<std::string, const Included*>>& found) {
  const auto& first = found.front().second->parameters.front();
  return std::all_of(found.begin(), found.end(), [&](const auto& member) {
    if (!member.second->given) return false;
    for (std::size_t field = 0; field < first.fields().size(); ++field)
      if (is_alike(first, field) &&
          member.second->parameters.front().value(field) != first.value(field))
        return false;
    return true;
  });
}

/// A parameter that was fitted once.
SharedParameter of_all_axes(const Included& included, std::size_t field) {
  const auto& effect = included.parameters.front();
  const auto& described = effect.fields()[field];
  const bool is_known = field < included.intervals.size();
  return {.name = std::string(described.name),
          .unit = std::string(described.unit),
          .mean = effect.value(field),
          .mean_low = is_known ? included.intervals[field][0] : no_value,
          .mean_high = is_known ? included.intervals[field][1] : no_value,
          .spread = 0.0,
          .spread_low = no_value,
          .spread_high = no_value,
          .p_equal = included.p_equal};
}

/// A parameter in each of those that an effect was found in. Of k axes that were fitted together
/// each has the error of them all, and a k-th of what that says.
std::vector<MemberValue> known_of(const std::vector<std::pair<std::string, const Included*>>& found,
                                  std::size_t field) {
  std::vector<MemberValue> known;
  for (const auto& [name, included] : found) {
    const auto interval = included->intervals.size() > field
                              ? included->intervals[field]
                              : std::array<double, 2>{no_value, no_value};
    const double error = (interval[1] - interval[0]) / (2.0 * normal_quantile(0.975));
    const auto& effect = included->parameters.front();
    const auto together = std::count_if(found.begin(), found.end(), [&](const auto& other) {
      return other.second->given &&
             other.second->parameters.front().value(field) == effect.value(field);
    });
    const bool is_shared = included->given && is_alike(effect, field);
    known.push_back({effect.value(field),
                     error * (is_shared ? std::sqrt(static_cast<double>(together)) : 1.0)});
  }
  return known;
}

std::vector<FleetMember> without_means(const std::vector<FleetMember>& members) {
  auto sampled = members;
  std::erase_if(sampled, [](const auto& member) { return member.mean_of > 1; });
  return sampled;
}

}  // namespace

std::vector<SharedEffect> shared_effects(const std::vector<FleetMember>& all) {
  const auto members = without_means(all);
  std::vector<SharedEffect> shared;
  for (const auto& cause : catalogue()) {
    std::map<std::string, std::vector<std::pair<std::string, const Included*>>> forms;
    for (const auto& member : members)
      if (const auto* included = found_in(member, std::string(cause.id())))
        forms[form_of(included->parameters.front())].emplace_back(member.name, included);
    for (const auto& [form, found] : forms) {
      if (found.size() < 2) continue;
      auto& one = shared.emplace_back(SharedEffect{
          .effect = std::string(cause.id()), .form = form, .members = {}, .parameters = {}});
      for (const auto& [name, included] : found) one.members.push_back(name);
      one.fitted_once = is_fitted_once(found);
      for (std::size_t field = 0; field < cause.fields().size(); ++field)
        one.parameters.push_back(one.fitted_once && is_alike(cause, field)
                                     ? of_all_axes(*found.front().second, field)
                                     : over_members(known_of(found, field), cause, field));
    }
  }
  std::stable_sort(shared.begin(), shared.end(), [](const auto& a, const auto& b) {
    return a.members.size() > b.members.size();
  });
  return shared;
}

std::string shared_in_words(const std::vector<FleetMember>& all) {
  const auto members = without_means(all);
  std::vector<std::string> everywhere, some, alone;
  for (const auto& cause : catalogue()) {
    std::vector<std::string> with;
    for (const auto& member : members)
      if (found_in(member, std::string(cause.id())) != nullptr) with.push_back(member.name);
    if (with.size() == members.size())
      everywhere.emplace_back(cause.id());
    else if (with.size() > 1)
      some.push_back(fmt::format("{} ({})", cause.id(), fmt::join(with, ", ")));
    else if (with.size() == 1)
      alone.push_back(fmt::format("{} ({})", cause.id(), with.front()));
  }
  const auto told = [](const char* who, const std::vector<std::string>& what) {
    return what.empty() ? std::string() : fmt::format("{}: {}. ", who, fmt::join(what, ", "));
  };
  auto words =
      told("All have", everywhere) + told("Some have", some) + told("One alone has", alone);
  if (words.empty()) return "None has an effect that has a name.";
  std::vector<std::string> once;
  for (const auto& shared : shared_effects(all))
    if (shared.fitted_once) once.push_back(shared.effect);
  words += told("Fitted once for all axes", once);
  words.pop_back();
  return words;
}

}  // namespace gyrostat::gap
