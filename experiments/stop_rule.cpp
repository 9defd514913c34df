#include "experiments/stop_rule.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "analysis/statistics/running.hpp"
#include "analysis/statistics/sequential.hpp"
#include "analysis/statistics/skewed_mean.hpp"
#include "analysis/statistics/summary.hpp"
#include "experiments/cell_summary.hpp"
#include "experiments/metric_names.hpp"
#include "experiments/ranking_words.hpp"
#include "experiments/study_ranges.hpp"
#include "experiments/trial.hpp"

namespace gyrostat {
namespace {

std::vector<std::size_t> read_methods(JsonObject& object, const std::string& key,
                                      const Cell& cell) {
  std::vector<std::string> ids;
  for (const auto& method : cell.methods) ids.push_back(method.id);
  std::vector<std::size_t> chosen;
  for (const auto& [value, place] : object.list(key)) {
    const auto id = value->is_string() ? value->get<std::string>() : value->dump();
    const auto found = std::find(ids.begin(), ids.end(), id);
    if (found == ids.end()) throw InputError(place, unknown_name("method", id, ids));
    chosen.push_back(static_cast<std::size_t>(found - ids.begin()));
  }
  return chosen;
}

/// The looks at a cell's results up to `trials`; its end is one, whatever ended it.
std::vector<std::uint32_t> looks_up_to(const StopRule& rule, std::uint32_t trials) {
  auto counts = look_counts(rule.at_least, trials);
  if (counts.empty() || counts.back() != trials) counts.push_back(trials);
  return counts;
}

constexpr std::size_t column_count = metric_count + status_names.size() + 1;

std::optional<std::string> narrow_enough(const Cell& cell, const OutcomeSource& trials) {
  const auto& rule = *cell.stop;
  std::vector<Running> means(rule.methods.size());
  trials([&](std::span<const double> outcomes) {
    for (std::size_t i = 0; i < means.size(); ++i)
      means[i].add(outcomes[rule.methods[i] * column_count + rule.metric]);
  });
  double widest = no_value;
  for (const auto& m : means) {
    if (m.count == 0.0) continue;  // a method without this metric
    widest = std::fmax(widest, m.count < 2.0 ? HUGE_VAL : half_width_95(m));
  }
  if (!(widest < rule.half_width_below)) return std::nullopt;
  return fmt::format("mean {} known to ± {:.3g} {}", Metrics::ids()[rule.metric], widest,
                     metric_unit(rule.metric));
}

std::optional<std::string> told_apart(const Cell& cell, std::uint32_t count,
                                      const OutcomeSource& trials) {
  const auto& rule = *cell.stop;
  struct Pair {
    std::size_t a, b;
    Running difference;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < rule.methods.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) pairs.push_back({rule.methods[j], rule.methods[i], {}});
  trials([&](std::span<const double> outcomes) {
    for (auto& pair : pairs)
      pair.difference.add(outcomes[pair.a * column_count + rule.metric] -
                          outcomes[pair.b * column_count + rule.metric]);
  });
  const auto counts = looks_up_to(rule, count);
  const double tail =
      normal_tail(sequential_bounds(counts, 0.05 / static_cast<double>(pairs.size())).back());
  std::string reason;
  for (const auto& [a, b, d] : pairs) {
    if (d.count < 2.0) return std::nullopt;
    const auto [low, high] = skewed_mean_interval(d, tail);
    const bool equal = -rule.margin <= low && high <= rule.margin;
    if (!equal && low <= 0.0 && high >= 0.0) return std::nullopt;
    const auto gap =
        d.mean < 0.0 ? with_interval(-d.mean, -high, -low) : with_interval(d.mean, low, high);
    reason +=
        fmt::format("{}{} {} {} by {} {} in {}", reason.empty() ? "" : "; ", cell.methods[a].id,
                    equal          ? "equals"
                    : d.mean < 0.0 ? "is below"
                                   : "is above",
                    cell.methods[b].id, gap, metric_unit(rule.metric), Metrics::ids()[rule.metric]);
  }
  return reason;
}

}  // namespace

StopRule read_stop(JsonObject object, const Cell& cell) {
  StopRule rule;
  rule.metric = metric_named(object.text("metric", std::string(judging_metric(cell))),
                             object.place_of("metric"));
  rule.at_least = static_cast<std::uint32_t>(
      object.number("at_least", 100, study_ranges::first_look, "trials"));
  const auto unit = metric_unit(rule.metric);
  if (object.has("separate") == object.has("half_width_below"))
    throw InputError(object.place(), "either \"separate\" or \"half_width_below\" is needed here");
  if (object.has("separate")) {
    rule.methods = read_methods(object, "separate", cell);
    rule.margin = object.number("margin", 0.0, ranges::non_negative, unit);
    for (std::size_t i = 0; i < rule.methods.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (rule.methods[i] == rule.methods[j])
          throw InputError(object.place_of("separate"), "a method stands twice");
    if (rule.methods.size() < 2)
      throw InputError(object.place_of("separate"), "at least two methods are needed here");
  } else {
    rule.half_width_below = object.number("half_width_below", 0.0, ranges::positive, unit);
    rule.methods = read_methods(object, "methods", cell);
    if (!object.has("methods"))
      for (std::size_t m = 0; m < cell.methods.size(); ++m) rule.methods.push_back(m);
    if (rule.methods.empty()) throw InputError(object.place_of("methods"), "the list is empty");
  }
  object.finish();
  return rule;
}

Json with_stop(Json study, const std::string& text) {
  const auto rule = text == "none" ? Json() : Json::parse(text, nullptr, false);
  if (rule.is_discarded() || !(rule.is_null() || rule.is_object()))
    throw InputError("--stop",
                     "neither \"none\" nor JSON as a study's \"stop\", "
                     R"({"half_width_below": 0.001} or {"separate": ["kf", "stf"]})");
  if (!study.is_object() || !study.contains("cells") || !study["cells"].is_array()) return study;
  for (auto& cell : study["cells"]) {
    if (!cell.is_object()) continue;
    cell.erase("stop");
    if (rule.is_object()) cell["stop"] = rule;
  }
  return study;
}

std::optional<std::string> stop_reason(const Cell& cell, std::uint32_t count,
                                       const OutcomeSource& trials) {
  if (!cell.stop) return std::nullopt;
  return cell.stop->half_width_below > 0.0 ? narrow_enough(cell, trials)
                                           : told_apart(cell, count, trials);
}

double comparisons_of_looks(const Cell& cell, std::size_t trials) {
  if (!cell.stop || cell.stop->half_width_below > 0.0 || trials == 0) return 1.0;
  const auto counts = looks_up_to(*cell.stop, static_cast<std::uint32_t>(trials));
  return 0.025 / normal_tail(sequential_bounds(counts, 0.05).back());
}

}  // namespace gyrostat
