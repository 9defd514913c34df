#include <gyrostat/experiments/blind/set_score.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/experiments/blind/share.hpp>

namespace gyrostat::gap {
namespace {

/// Effects that are there and named, there, and named.
struct Found {
  double right = 0, there = 0, named = 0;
  bool exact() const { return right == there && right == named; }
};

Found found_in(const Scored& scored) {
  const auto named = scored.answer.named();
  Found found{0, double(scored.label.effects.size()), double(named.size())};
  for (const auto& name : named) found.right += holds(scored.label.effects, name);
  return found;
}

/// A ratio of sums over recordings.
TableCell ratio(const std::vector<Found>& all, double Found::*above, double Found::*below) {
  return bootstrapped(all.size(), [&](std::span<const std::size_t> drawn) {
    double numerator = 0, denominator = 0;
    for (const auto k : drawn) numerator += all[k].*above, denominator += all[k].*below;
    return denominator > 0 ? numerator / denominator : no_value;
  });
}

bool is_set(const Scored& scored) { return scored.label.effects.size() > 1; }

/// Effects of the catalogue that an answer on this recording is held to, with what it says of each.
std::map<std::string, double> stated_of(const Scored& scored) {
  std::map<std::string, double> stated;
  for (const auto& effect : catalogue())
    if (!holds(scored.label.own, std::string(effect.id()))) stated[std::string(effect.id())] = 0.0;
  for (const auto& [effect, inclusion] : scored.answer.inclusions) stated[effect] = inclusion;
  return stated;
}

double squared(double value) { return value * value; }

}  // namespace

Table set_table(const std::string& title, const std::vector<Scored>& all) {
  std::map<std::tuple<std::string, std::string, std::string>, std::vector<const Scored*>> groups;
  for (const auto& scored : all) {
    if (!is_set(scored)) continue;
    const auto& label = scored.label;
    groups[{label.scenario, fmt::format("{}", label.effects.size()), label.strength}].push_back(
        &scored);
    groups[{"all", "all", label.strength}].push_back(&scored);
    groups[{"all", fmt::format("{}", label.effects.size()), "all"}].push_back(&scored);
    groups[{"all", "all", "all"}].push_back(&scored);
  }
  Table table{
      .title = title + ": sets of effects",
      .columns = {{"scenario", ""},
                  {"effects", ""},
                  {"strength", ""},
                  {"recordings", ""},
                  {"recall", ""},
                  {"precision", ""},
                  {"exact", ""},
                  {"median closed", ""}},
      .notes = {"recall: of the effects that are there, those named, with a probability of a "
                "half or more; precision: of those named, those that are there; exact: all "
                "of them and no other; 95 % intervals by bootstrap over recordings, of exact "
                "by Wilson"}};
  for (const auto& [key, group] : groups) {
    std::vector<Found> found;
    std::vector<double> closed;
    Share exact;
    for (const auto* scored : group) {
      found.push_back(found_in(*scored));
      exact.add(found.back().exact());
      if (scored->answer.closed) closed.push_back(*scored->answer.closed);
    }
    const auto& [scenario, size, strength] = key;
    table.rows.push_back({scenario, size, strength, static_cast<double>(group.size()),
                          ratio(found, &Found::right, &Found::there),
                          ratio(found, &Found::right, &Found::named), exact.text(),
                          bootstrapped_median(closed)});
  }
  return table;
}

Table set_effects_table(const std::string& title, const std::vector<Scored>& all) {
  struct Naming {
    Share strong, medium, wrongly;
    std::map<std::string, double> instead;
  };
  std::map<std::string, Naming> tallies;
  for (const auto& scored : all) {
    if (!is_set(scored)) continue;
    const auto named = scored.answer.named();
    const auto& there = scored.label.effects;
    for (const auto& [effect, unused] : stated_of(scored)) {
      auto& tally = tallies[effect];
      const bool is_named = holds(named, effect);
      if (!holds(there, effect)) {
        tally.wrongly.add(is_named);
        continue;
      }
      (scored.label.strength == "strong" ? tally.strong : tally.medium).add(is_named);
      if (is_named) continue;
      for (const auto& other : named)
        if (!holds(there, other)) tally.instead[other] += 1;
    }
  }
  Table table{.title = title + ": effects in sets",
              .columns = {{"effect", ""},
                          {"named, strong", ""},
                          {"named, else", ""},
                          {"named where it is not", ""},
                          {"wrong names where it is missed", ""}}};
  for (const auto& [effect, tally] : tallies) {
    std::vector<std::string> instead;
    for (const auto& [name, times] : tally.instead)
      instead.push_back(fmt::format("{} {:.0f}", name, times));
    table.rows.push_back({effect, tally.strong.plain(), tally.medium.plain(), tally.wrongly.plain(),
                          fmt::format("{}", fmt::join(instead, ", "))});
  }
  return table;
}

Table inclusion_table(const std::string& title, const std::vector<Scored>& all) {
  struct Bin {
    double from, to;
    Share right;
    double stated = 0;
  };
  std::array bins = {Bin{0.0, 0.2, {}},  Bin{0.2, 0.5, {}},   Bin{0.5, 0.8, {}},
                     Bin{0.8, 0.95, {}}, Bin{0.95, 0.99, {}}, Bin{0.99, 1.0, {}}};
  std::vector<double> of_named, of_catalogue, named_count, catalogue_count;
  for (const auto& scored : all) {
    double named = 0, catalogued = 0;
    const auto stated = stated_of(scored);
    for (const auto& [effect, inclusion] : stated)
      catalogued += squared(inclusion - holds(scored.label.effects, effect));
    for (const auto& [effect, inclusion] : scored.answer.inclusions) {
      const bool there = holds(scored.label.effects, effect);
      named += squared(inclusion - there);
      auto bin = std::find_if(bins.begin(), bins.end(),
                              [p = inclusion](const Bin& b) { return p < b.to; });
      if (bin == bins.end()) bin = bins.end() - 1;
      bin->stated += inclusion;
      bin->right.add(there);
    }
    of_named.push_back(named), of_catalogue.push_back(catalogued);
    named_count.push_back(double(scored.answer.inclusions.size()));
    catalogue_count.push_back(double(stated.size()));
  }
  const auto mean = [](const std::vector<double>& sums, const std::vector<double>& counts) {
    const auto text = bootstrapped(sums.size(), [&](std::span<const std::size_t> drawn) {
      double sum = 0, count = 0;
      for (const auto k : drawn) sum += sums[k], count += counts[k];
      return count > 0 ? sum / count : no_value;
    });
    return text.index() == 0 ? std::string("–") : std::get<std::string>(text);
  };
  Table table{.title = title + ": are the probabilities right?",
              .columns = {{"stated", ""}, {"effects", ""}, {"mean stated", "1"}, {"right", ""}}};
  for (const auto& bin : bins)
    table.rows.push_back({fmt::format("{:g} to {:g}", bin.from, bin.to), bin.right.count,
                          cell(bin.right.count > 0 ? bin.stated / bin.right.count : no_value),
                          bin.right.text()});
  table.notes = {
      fmt::format("Brier score of the effects that are given a probability: {}; over the "
                  "whole catalogue, those that are given none having 0: {}",
                  mean(of_named, named_count), mean(of_catalogue, catalogue_count))};
  return table;
}

Table closed_table(const std::string& title, const std::vector<Scored>& all) {
  Table table{
      .title = title + ": how much of the gap is closed",
      .columns = {{"set", ""},
                  {"recordings", ""},
                  {"median closed", ""},
                  {"interval reaches 1", ""}},
      .notes = {"the right simulator closes all of a gap: where the set is exact its interval "
                "should reach 1 in 95 %; recordings with effects of their own, and near forms, "
                "have no such simulator and are left out"}};
  struct Group {
    std::vector<double> closed;
    Share reaches;
  };
  std::map<std::string, Group> groups;
  for (const auto& scored : all) {
    const auto& label = scored.label;
    if (label.effects.empty() || !label.own.empty() || !label.form.empty() ||
        !scored.answer.closed_interval || !scored.answer.closed)
      continue;
    auto& group = groups[found_in(scored).exact() ? "exact" : "another"];
    group.closed.push_back(*scored.answer.closed);
    group.reaches.add(scored.answer.closed_interval->second >= 1.0);
  }
  for (const auto& [name, group] : groups)
    table.rows.push_back({name, static_cast<double>(group.closed.size()),
                          bootstrapped_median(group.closed), group.reaches.text()});
  return table;
}

}  // namespace gyrostat::gap
