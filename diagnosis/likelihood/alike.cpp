#include <gyrostat/diagnosis/likelihood/alike.hpp>

#include <algorithm>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/alike_forms.hpp>

namespace gyrostat::gap {
namespace {

double odds_of(const FoundSet& axis, std::string_view effect) {
  const auto member = std::find_if(axis.members.begin(), axis.members.end(),
                                   [&](const auto& m) { return m.effect == effect; });
  return member == axis.members.end() ? 0.0 : member->log_odds;
}

bool has_effect(const Effects& effects, std::string_view id) {
  return std::any_of(effects.begin(), effects.end(), [&](const auto& e) { return e.id() == id; });
}

/// What the axes have alike of one part, of each axis.
std::vector<std::vector<Given>> alike_of_part(const Axes& axes, std::string_view part) {
  std::vector<std::vector<Given>> given(axes.size());
  double own = 0.0;
  for (const auto* axis : axes) own += axis->score;
  auto forms = forms_on(axes, part);
  if (forms.size() == 1 && forms.front().told.front().empty()) return given;
  const Form* best = nullptr;
  for (auto& form : forms) {
    judge(axes, part, form);
    if (best == nullptr || form.score > best->score) best = &form;
  }
  if (best->score <= own || best->best.empty()) return given;

  for (const auto& effect : best->best) {
    const auto id = effect.id();
    Given one{.effect = effect,
              .p_equal = p_equal(axes, *best, effect),
              .intervals = intervals_of(axes, *best, effect)};
    // That no axis has it, each explained as it is best without.
    double least = best->score;
    for (const auto* axis : axes) least -= axis->score - odds_of(*axis, id);
    for (const auto& form : forms) {
      if (has_effect(form.told.front(), id)) continue;
      least = std::min(least, best->score - form.score);
      constexpr double nearly = 3.0;
      const auto& other = form.best;
      if (other.size() == best->best.size() && best->score - form.score < nearly)
        for (const auto& rival : other)
          if (!has_effect(best->best, rival.id()))
            one.rivals.push_back(
                {rival, std::string(rival.id()), std::string(id), form.score - best->score});
    }
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      const bool has_its_own = has_effect(of_part(*axes[axis], part), id);
      one.log_odds = has_its_own ? least : std::min(least, best->score - own);
      given[axis].push_back(one);
    }
  }
  return given;
}

}  // namespace

std::vector<std::vector<Given>> alike_on_axes(const std::vector<FoundSet>& all) {
  std::vector<std::vector<Given>> given(all.size());
  Axes axes;
  std::vector<std::size_t> places;
  for (std::size_t axis = 0; axis < all.size(); ++axis)
    if (all[axis].worth) axes.push_back(&all[axis]), places.push_back(axis);
  if (axes.size() < 2) return given;
  std::vector<std::string_view> parts;
  for (const auto& cause : cause_types())
    if (!cause.part.empty() && std::find(parts.begin(), parts.end(), cause.part) == parts.end())
      parts.push_back(cause.part);
  for (const auto part : parts) {
    const auto of_part = alike_of_part(axes, part);
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      given[places[axis]].insert(given[places[axis]].end(), of_part[axis].begin(),
                                 of_part[axis].end());
  }
  return given;
}

}  // namespace gyrostat::gap
