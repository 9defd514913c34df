#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/experiments/blind/blind_check.hpp>
#include <gyrostat/experiments/blind/blind_labels.hpp>

namespace gyrostat::gap {
namespace {

/// Uniform choices, one after another.
class Choices {
 public:
  Choices(std::uint64_t seed, std::uint32_t trial) : stream_(seed, trial, "blind_check/sets") {}

  std::size_t among(std::size_t count) {
    const auto chosen = static_cast<std::size_t>(stream_.uniform(drawn_++) * double(count));
    return std::min(chosen, count - 1);
  }
  template <class T>
  void shuffle(std::vector<T>& values) {
    for (std::size_t k = values.size(); k > 1; --k) std::swap(values[k - 1], values[among(k)]);
  }

 private:
  NormalStream stream_;
  std::uint64_t drawn_ = 0;
};

/// The single effects of a scenario that a recording of it can show: their cases, by name.
using Pool = std::map<std::string, std::vector<const BlindCase*>>;

void put_noise(BlindCase& c, std::size_t number) {
  if (!c.noises.empty()) c.noises = {c.noises[number % c.noises.size()]};
  if (!c.noises.empty()) c.scenario.recorded_noise_dps = c.noises.front().dps;
}

Pool pool_of(const BlindCheck& check, const BlindCase& base) {
  auto plain = base;
  put_noise(plain, 0);
  const Conditions conditions(recorded(plain, {check.seed, 0}));
  Pool pool;
  for (const auto& c : check.cases) {
    if (c.scenario_name != base.scenario_name || c.effects.size() != 1) continue;
    const auto& sampling = c.scenario.sampling;
    if (sampling.duration_s != base.scenario.sampling.duration_s ||
        sampling.rate_hz != base.scenario.sampling.rate_hz)
      continue;
    const auto& name = c.effects.front();
    const auto* cause = cause_types().find(name);
    if (cause && cause->why_not_assessable(conditions).empty()) pool[name].push_back(&c);
  }
  return pool;
}

bool exclude_each_other(const BlindCheck& check, const std::string& one, const std::string& other) {
  return std::any_of(check.never_together.begin(), check.never_together.end(),
                     [&](const auto& group) { return holds(group, one) && holds(group, other); });
}

/// One set: that many effects, each in one of its forms at one of the strengths allowed.
BlindCase drawn_set(const BlindCheck& check, const BlindSets& sets, const Pool& pool,
                    std::size_t size, const std::string& strength, std::uint32_t trial) {
  Choices choices(check.seed, trial);
  BlindCase c = sets.base;
  c.strength = strength;
  std::vector<std::string> names, forms;
  for (const auto& [name, unused] : pool) names.push_back(name);
  choices.shuffle(names);
  for (const auto& name : names) {
    if (c.effects.size() == size) break;
    const auto excludes = [&](const auto& other) { return exclude_each_other(check, name, other); };
    if (std::any_of(c.effects.begin(), c.effects.end(), excludes) ||
        std::any_of(sets.base.own.begin(), sets.base.own.end(), excludes))
      continue;
    std::vector<const BlindCase*> candidates;
    for (const auto* single : pool.at(name))
      if (single->strength == strength || (strength == "mixed" && single->strength != "weak"))
        candidates.push_back(single);
    if (candidates.empty()) continue;
    const auto& single = *candidates[choices.among(candidates.size())];
    c.effects.push_back(name);
    c.scenario.effects.push_back(single.scenario.effects.back());
    for (const auto& also : single.own)
      if (!holds(c.own, also)) c.own.push_back(also);
    if (!single.form.empty()) forms.push_back(name + " as " + single.form);
  }
  if (c.effects.size() < size)
    throw InputError("sets",
                     fmt::format("scenario '{}' has no {} effects of strength '{}' that go "
                                 "together and that {:g} s at {:g} Hz can show",
                                 c.scenario_name, size, strength, c.scenario.sampling.duration_s,
                                 c.scenario.sampling.rate_hz));
  // What another effect of the set may be called is right where it is itself in the set.
  std::erase_if(c.own, [&](const auto& name) { return holds(c.effects, name); });
  c.form = fmt::format("{}", fmt::join(forms, ", "));
  if (sets.left_out) c.left_out = c.effects.front();
  return c;
}

}  // namespace

std::vector<BlindCase> drawn_cases(const BlindCheck& check) {
  std::vector<BlindCase> all;
  std::map<std::string, std::size_t> noise_of;  // how many recordings of each scenario there are
  const auto add = [&](BlindCase c) {
    put_noise(c, noise_of[c.scenario_name]++);
    all.push_back(std::move(c));
  };
  for (const auto& c : check.cases)
    for (std::uint32_t k = 0, n = c.effects.empty() ? check.none_recordings : check.recordings;
         k < n; ++k)
      add(c);
  for (const auto& sets : check.sets) {
    const auto pool = pool_of(check, sets.base);
    for (const auto& strength : sets.strengths)
      for (const auto size : sets.sizes)
        for (std::uint32_t k = 0, n = sets.recordings ? sets.recordings : check.recordings; k < n;
             ++k)
          add(drawn_set(check, sets, pool, size, strength, static_cast<std::uint32_t>(all.size())));
  }
  return all;
}

}  // namespace gyrostat::gap
