#include <gyrostat/diagnosis/likelihood/alike_forms.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/analysis/statistics/random_effects.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>

namespace gyrostat::gap {
namespace {

/// Which effects there are, and their form: what is a whole number, and which of what is alike is
/// 0.
std::string form_of(const Effects& effects) {
  std::string form;
  for (const auto& effect : effects) {
    form += effect.id();
    for (std::size_t f = 0; f < effect.fields().size(); ++f)
      if (effect.fields()[f].range.whole)
        form += fmt::format(" {:g}", effect.value(f));
      else if (is_alike(effect, f))
        form += effect.value(f) == 0.0 ? " none" : " some";
  }
  return form;
}

/// The axis' effects of a part with a rival of the same part, in the place of one of them or beside
/// them.
std::vector<Effects> rivals_of_part(const FoundSet& axis, std::string_view part) {
  std::vector<Effects> all;
  for (const auto& rival : axis.rivals) {
    auto effects = of_part(axis, part);
    const auto* cause = cause_types().find(rival.effect);
    const auto place = std::find_if(effects.begin(), effects.end(), [&](const auto& effect) {
      return effect.id() == rival.instead_of;
    });
    if (cause == nullptr || cause->part != part) continue;
    if (rival.instead_of.empty())
      effects.push_back(rival.found);
    else if (place != effects.end())
      *place = rival.found;
    else
      continue;
    std::sort(effects.begin(), effects.end(),
              [](const auto& a, const auto& b) { return a.id() < b.id(); });
    all.push_back(std::move(effects));
  }
  return all;
}

std::optional<MemberValue> known(const FoundSet& axis, std::string_view effect, std::size_t field) {
  for (const auto& interval : axis.intervals) {
    const auto& there = axis.scenario.effects[interval.effect];
    if (there.id() == effect && interval.field == field)
      return MemberValue{there.value(field),
                         (interval.high - interval.low) / (2.0 * normal_quantile(0.975))};
  }
  return {};
}

/// Of a parameter that is alike, over the axes whose set has the form.
std::vector<MemberValue> known_values(const Axes& axes, const Form& form, std::string_view effect,
                                      std::size_t field) {
  std::vector<MemberValue> values;
  for (const auto axis : form.of_set)
    if (const auto value = known(*axes[axis], effect, field); value && value->error > 0.0)
      values.push_back(*value);
  return values;
}

/// With the values' error.
MemberValue weighted_mean(const std::vector<MemberValue>& values) {
  double weights = 0.0, sum = 0.0;
  for (const auto& v : values) {
    weights += 1.0 / (v.error * v.error);
    sum += v.value / (v.error * v.error);
  }
  return {sum / weights, 1.0 / std::sqrt(weights)};
}

std::optional<Effects> mean_of(const Axes& axes, const Form& form) {
  if (form.of_set.size() < 2) return {};
  auto effects = of_part(*axes[form.of_set.front()],
                         cause_types().named(form.told.front().front().id(), "effects").part);
  for (auto& effect : effects)
    for (std::size_t field = 0; field < effect.fields().size(); ++field)
      if (is_alike(effect, field))
        if (const auto values = known_values(axes, form, effect.id(), field); !values.empty())
          effect.value(field) = weighted_mean(values).value;
  return effects;
}

}  // namespace

Effects of_part(const FoundSet& axis, std::string_view part) {
  Effects effects;
  for (const auto& effect : axis.scenario.effects)
    if (const auto* cause = cause_types().find(effect.id());
        cause != nullptr && cause->part == part)
      effects.push_back(effect);
  std::sort(effects.begin(), effects.end(),
            [](const auto& a, const auto& b) { return a.id() < b.id(); });
  return effects;
}

std::vector<Form> forms_on(const Axes& axes, std::string_view part) {
  std::map<std::string, Form> forms;
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    auto effects = of_part(*axes[axis], part);
    auto& form = forms[form_of(effects)];
    form.told.push_back(std::move(effects));
    form.of_set.push_back(axis);
    for (auto& rival : rivals_of_part(*axes[axis], part))
      forms[form_of(rival)].told.push_back(std::move(rival));
  }
  std::vector<Form> all;
  for (auto& [name, form] : forms) all.push_back(std::move(form));
  return all;
}

void judge(const Axes& axes, std::string_view part, Form& form) {
  auto tried = form.told;
  if (!form.told.front().empty())
    if (auto mean = mean_of(axes, form)) tried.insert(tried.begin(), std::move(*mean));
  for (const auto& effects : tried) {
    double sum = 0.0, cost = 0.0;
    bool is_had = true;
    for (const auto* axis : axes) {
      const auto worth = axis->worth(part, effects);
      is_had = is_had && worth;
      if (!is_had) break;
      sum += worth->score;
      cost = worth->cost;
    }
    if (!is_had || sum - cost <= form.score) continue;
    form.score = sum - cost;
    form.best = effects;
  }
}

double p_equal(const Axes& axes, const Form& form, const Effect& effect) {
  double q = 0.0, degrees = 0.0;
  for (std::size_t field = 0; field < effect.fields().size(); ++field) {
    if (!is_alike(effect, field)) continue;
    const auto values = known_values(axes, form, effect.id(), field);
    if (values.size() < 2) continue;
    q += q_between(values, 0.0);
    degrees += static_cast<double>(values.size() - 1);
  }
  return degrees > 0.0 ? chi_squared_upper_tail(q, degrees) : no_value;
}

std::vector<std::array<double, 2>> intervals_of(const Axes& axes, const Form& form,
                                                const Effect& effect) {
  std::vector<std::array<double, 2>> intervals(effect.fields().size(), {no_value, no_value});
  for (std::size_t field = 0; field < effect.fields().size(); ++field) {
    if (!is_alike(effect, field)) continue;
    const auto values = known_values(axes, form, effect.id(), field);
    if (values.empty()) continue;
    const double reach = normal_quantile(0.975) * weighted_mean(values).error;
    intervals[field] = {effect.value(field) - reach, effect.value(field) + reach};
  }
  return intervals;
}

}  // namespace gyrostat::gap
