#include <gyrostat/experiments/findings/study_tuning.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include <gyrostat/analysis/error_metric.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/core/words.hpp>

namespace gyrostat {
namespace {

/// "phi=0.1:0.9"; at least one of the methods has the parameter, and the range is within its own.
std::pair<std::string, SearchRange> tuning_range(const std::string& text,
                                                 const std::vector<Method>& methods,
                                                 const std::string& prefix) {
  const auto equals = text.find('='), colon = text.find(':', equals);
  const std::string place = prefix + "range " + text;
  SearchRange range;
  const auto read = [&](const std::string& word, double& value) {
    char* end = nullptr;
    value = std::strtod(word.c_str(), &end);
    return !word.empty() && *end == '\0' && std::isfinite(value);
  };
  if (colon == std::string::npos || !read(text.substr(equals + 1, colon - equals - 1), range.low) ||
      !read(text.substr(colon + 1), range.high) || !(range.low < range.high))
    throw InputError(place, "a name and two bounds are needed, as phi=0.1:0.9");
  const auto name = text.substr(0, equals);
  std::vector<std::string> known;
  bool is_known = false;
  for (const auto& method : methods)
    for (const auto& field : method.type().fields) {
      known.emplace_back(field.name);
      if (field.name != name) continue;
      is_known = true;
      range.whole = field.range.whole;
      for (const double bound : {range.low, range.high})
        if (!field.range.contains(bound))
          throw InputError(place, fmt::format("{:g} {} is out of range; allowed of {}: {}", bound,
                                              field.unit, method.id, values_in_words(field.range)));
    }
  if (!is_known) throw InputError(place, unknown_name("parameter", name, known));
  return {name, range};
}

/// Which methods of a cell are tuned: those named; else those that the study gives a "tune"; else
/// every contender.
std::vector<std::size_t> methods_to_tune(const Cell& cell, const TuningRequest& request) {
  const bool any_tune = std::any_of(cell.methods.begin(), cell.methods.end(),
                                    [](const Method& m) { return !m.tune.empty(); });
  std::vector<std::size_t> chosen;
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    const auto& method = cell.methods[m];
    const auto& named = request.methods;
    const bool is_named = std::find(named.begin(), named.end(), method.id) != named.end();
    if (!named.empty() ? is_named : any_tune ? !method.tune.empty() : method.role().is_contender())
      chosen.push_back(m);
  }
  return chosen;
}

struct ToTune {
  std::size_t cell, method;
};

std::vector<ToTune> all_to_tune(const Study& study, const TuningRequest& request) {
  const Cell* only = request.cell.empty()
                         ? nullptr
                         : &cell_named(study, request.cell, request.option_prefix + "cell");
  std::vector<ToTune> all;
  std::vector<std::string> ids;
  for (std::size_t c = 0; c < study.cells.size(); ++c) {
    if (only != nullptr && only != &study.cells[c]) continue;
    for (const auto& method : study.cells[c].methods) ids.push_back(method.id);
    for (const auto m : methods_to_tune(study.cells[c], request)) all.push_back({c, m});
  }
  for (const auto& name : request.methods)
    if (std::find(ids.begin(), ids.end(), name) == ids.end())
      throw InputError(request.option_prefix + "method", unknown_name("method", name, ids));
  if (all.empty()) throw InputError(study.path, "none of its methods can be tuned");
  return all;
}

TuningGoal goal_of(const TuningRequest& request, const Study& study,
                   const std::vector<ToTune>& all) {
  using Kind = TrialMeasure::Kind;
  const auto& prefix = request.option_prefix;
  const std::vector<std::string> measures = {"mean", "cvar95"};
  if (std::find(measures.begin(), measures.end(), request.by) == measures.end())
    throw InputError(prefix + "by", unknown_name("measure", request.by, measures));
  const auto check = [&](const char* option, double value, const Range& allowed) {
    if (!allowed.contains(value))
      throw InputError(prefix + option, fmt::format("{:g} is out of range; allowed: {}", value,
                                                    values_in_words(allowed)));
  };
  check("above", request.above.value_or(0.0), ranges::non_negative);
  check("budget", static_cast<double>(request.goal.budget), {.from = 400, .to = 1e8});
  check("fresh", request.goal.fresh, {.from = 50, .to = 1e7});
  TuningGoal goal = request.goal;
  goal.metric = error_metric_named(request.metric, request.option_prefix + "metric");
  goal.measure = {.kind = request.above          ? Kind::probability
                          : request.by == "mean" ? Kind::mean
                                                 : Kind::cvar95,
                  .limit = request.above.value_or(0.0)};
  std::vector<Method> methods;
  for (const auto& [c, m] : all) methods.push_back(study.cells[c].methods[m]);
  for (const auto& text : request.ranges)
    goal.ranges.insert(tuning_range(text, methods, request.option_prefix));
  return goal;
}

}  // namespace

StudyTuning tune_study(const Study& study, const TuningRequest& request, const RunOptions& options,
                       const TuningProgress& progress) {
  if (!study.designs.empty())
    throw InputError(study.path,
                     "a cell with a \"design\" or a \"grid\" stands for many, which have no "
                     "values in common; tune the study without it");
  const auto all = all_to_tune(study, request);
  StudyTuning found{.goal = goal_of(request, study, all), .cells = {}};
  auto& tunings = found.cells;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [c, m] = all[i];
    const auto& cell = study.cells[c];
    if (tunings.empty() || tunings.back().cell != c)
      tunings.push_back({.cell = c, .name = cell.name, .methods = {}});
    const auto tell = [&](const std::string& what, double share) {
      if (progress)
        progress(fmt::format("{}: {}", cell.name, what),
                 (static_cast<double>(i) + share) / static_cast<double>(all.size()));
    };
    tunings.back().methods.push_back(tune_method(cell, m, study.seed, found.goal, options, tell));
  }
  return found;
}

}  // namespace gyrostat
