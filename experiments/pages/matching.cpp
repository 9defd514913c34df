#include <gyrostat/experiments/pages/matching.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/search/covariance_search.hpp>
#include <gyrostat/analysis/statistics/summary.hpp>
#include <gyrostat/experiments/run/runner.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/json_path.hpp>

namespace gyrostat {
namespace {

bool concerns(const MatchFree& free, const Json& cell) {
  return free.cells.empty() || std::find(free.cells.begin(), free.cells.end(),
                                         cell.value("name", "")) != free.cells.end();
}

void set_free(const MatchFree& free, double value, Json& study, const std::string& place) {
  for (auto& cell : study["cells"])
    if (concerns(free, cell)) set_at(cell, free.path, value, place);
}

/// The study at the given values of the free parameters.
Study study_at(const Match& match, const Json& json, const std::vector<double>& values) {
  Json varied = json;
  for (std::size_t i = 0; i < values.size(); ++i)
    set_free(match.free[i], values[i], varied, match.title + ": free");
  return parse_study(varied, match.study_path);
}

/// The trials of every target, from one run of the study.
std::vector<Summary> reached_by(const Match& match, Study study, std::uint32_t trials,
                                int threads) {
  std::vector<Summary> reached(match.targets.size());
  for (auto& cell : study.cells) {
    cell.trials = trials;
    const auto result = run_cell(cell, study.seed, {.threads = threads, .progress = {}});
    for (std::size_t t = 0; t < reached.size(); ++t) {
      const auto& target = match.targets[t];
      if (target.cell != cell.name) continue;
      for (std::size_t m = 0; m < cell.methods.size(); ++m)
        if (cell.methods[m].id == target.method)
          reached[t] = summarise(metric_values(result, m, target.metric));
    }
  }
  return reached;
}

double distance(const Match& match, const std::vector<Summary>& reached) {
  double sum = 0.0;
  for (std::size_t t = 0; t < reached.size(); ++t) {
    const double deviation =
        (reached[t].mean - match.targets[t].value) / match.targets[t].tolerance;
    const double square = deviation * deviation;
    sum += match.loss == MatchLoss::squares ? square : std::log1p(square * square);
  }
  return sum;
}

/// Tunes every cell's methods at `values` and writes what was found into the JSON as fixed
/// parameters, so that the search that follows does not tune at every step.
Json with_tuning(const Match& match, const Json& json, const std::vector<double>& values) {
  Json fixed = json;
  const Study study = study_at(match, json, values);
  for (std::size_t c = 0; c < study.cells.size(); ++c) {
    const auto& cell = study.cells[c];
    Series buffer;
    const auto calibration =
        cell.needs_calibration() ? calibrate_cell(cell, study.seed, 0, buffer) : Calibration{};
    const auto tuned = tune_methods(cell, calibration, study.seed);
    auto& methods = fixed["cells"][c]["filters"];
    for (std::size_t m = 0; m < tuned.size(); ++m) {
      if (tuned[m].values.empty()) continue;
      for (const auto& [name, value] : tuned[m].values) methods[m]["parameters"][name] = value;
      methods[m].erase("tune");
    }
  }
  return fixed;
}

void check_target(const MatchTarget& target, const Study& study, const std::string& place) {
  std::vector<std::string> cells, methods;
  for (const auto& cell : study.cells) {
    cells.push_back(cell.name);
    if (cell.name != target.cell) continue;
    for (const auto& method : cell.methods) {
      methods.push_back(method.id);
      if (method.id == target.method) return;
    }
    throw InputError(place, unknown_name("method", target.method, methods));
  }
  throw InputError(place, unknown_name("cell", target.cell, cells));
}

/// A quarter of the range, about `value`.
SearchRange about(const SearchRange& range, double value) {
  const double at = range.low > 0.0 ? std::log(value / range.low) / std::log(range.high / range.low)
                                    : (value - range.low) / (range.high - range.low);
  return {range.at(std::max(0.0, at - 0.125)), range.at(std::min(1.0, at + 0.125)), range.whole};
}

/// Which of `names` the text under `key` is; the first where there is none.
std::size_t chosen(JsonObject& object, const char* key, const std::vector<std::string>& names) {
  const auto name = object.text(key, names.front());
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw InputError(object.place_of(key), unknown_name(key, name, names));
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

Match read_match(const std::string& path) {
  const Json json = read_json(path);
  JsonObject object(json, path + ":");
  Match match;
  match.title = object.text("title", path);
  const auto file = object.text("study", "");
  if (file.empty())
    throw InputError(object.place_of("study"), "is missing; required: the path of a study file");
  match.study_path = (std::filesystem::path(path).parent_path() / file).lexically_normal().string();
  match.study = read_json(match.study_path);
  const Study study = parse_study(match.study, match.study_path);
  match.trials = static_cast<std::uint32_t>(object.number("trials", 20, ranges::count, "trials"));
  match.evaluations = static_cast<int>(object.number("evaluations", 200, ranges::count, ""));
  match.rounds = static_cast<int>(object.number("rounds", 2, ranges::count, ""));
  match.search = chosen(object, "search", {"box", "covariance"}) == 0 ? MatchSearch::box
                                                                      : MatchSearch::covariance;
  match.loss =
      chosen(object, "loss", {"squares", "met"}) == 0 ? MatchLoss::squares : MatchLoss::met;
  std::vector<std::string> names;
  for (const auto& cell : study.cells) names.push_back(cell.name);
  for (const auto& [value, place] : object.list("free")) {
    JsonObject entry(*value, place);
    const double low = entry.number("low", 0.0, ranges::any, "");
    const double high = entry.number("high", 1.0, ranges::any, "");
    if (!(low < high)) throw InputError(place, "\"low\" is not below \"high\"");
    const bool whole = entry.number("whole", 0, ranges::flag, "") != 0.0;
    MatchFree free{.path = entry.text("path", ""), .range = {low, high, whole}, .cells = {}};
    for (const auto& [cell, cell_place] : entry.list("cells")) {
      if (!cell->is_string()) throw InputError(cell_place, "the name of a cell is needed here");
      free.cells.push_back(cell->get<std::string>());
      if (std::find(names.begin(), names.end(), free.cells.back()) == names.end())
        throw InputError(cell_place, unknown_name("cell", free.cells.back(), names));
    }
    if (entry.has("start"))
      free.start = entry.number("start", 0.0, Range{.from = low, .to = high}, "");
    entry.finish();
    match.free.push_back(std::move(free));
  }
  for (const auto& [value, place] : object.list("targets")) {
    JsonObject entry(*value, place);
    MatchTarget target;
    target.cell = entry.text("cell", "");
    target.method = entry.text("method", "");
    target.metric = metric_named(entry.text("metric", ""), entry.place_of("metric"));
    target.value = entry.number("value", 0.0, ranges::any, "");
    target.tolerance = entry.number("tolerance", 1.0, ranges::positive, "");
    entry.finish();
    check_target(target, study, place);
    match.targets.push_back(target);
  }
  object.finish();
  if (match.targets.empty()) throw InputError(path, "\"targets\" is missing or empty");
  return match;
}

MatchResult run_match(const Match& match, std::ostream& log, int threads) {
  std::vector<SearchRange> ranges;
  MatchResult result;
  for (const auto& free : match.free) {
    ranges.push_back(free.range);
    result.values.push_back(free.range.at(0.5));
  }
  bool goes_on = false;
  for (std::size_t i = 0; i < match.free.size(); ++i)
    if (!std::isnan(match.free[i].start)) {
      result.values[i] = match.free[i].start;
      ranges[i] = about(ranges[i], match.free[i].start);
      goes_on = true;
    }
  Json fixed = match.study;
  for (int round = 0; round < match.rounds; ++round) {
    fixed = with_tuning(match, match.study, result.values);
    const auto at = [&](const std::vector<double>& values) {
      return distance(match,
                      reached_by(match, study_at(match, fixed, values), match.trials, threads));
    };
    auto found = match.search == MatchSearch::box
                     ? box_search(ranges, match.evaluations, at)
                     : covariance_search(ranges, match.evaluations, at);
    if (goes_on) {
      const double before = at(result.values);
      if (!(found.objective < before)) found = {result.values, before, found.evaluations + 1};
    }
    result.values = found.values;
    log << fmt::format("round {}: distance {:.4g} after {} evaluations\n", round + 1,
                       found.objective, found.evaluations);
  }
  result.study = with_tuning(match, match.study, result.values);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    set_free(match.free[i], result.values[i], result.study, match.title);
  // Another seed: the numbers that are shown did not choose the scenario.
  Study fresh = study_at(match, result.study, result.values);
  fresh.seed += 1;
  const auto reached = reached_by(match, fresh, 10 * match.trials, threads);
  for (const auto& summary : reached) {
    result.reached.push_back(summary.mean);
    result.half_widths.push_back(summary.half_width_95);
    result.spreads.push_back(summary.std);
  }
  for (std::size_t t = 0; t < reached.size(); ++t)
    result.objective +=
        std::pow((reached[t].mean - match.targets[t].value) / match.targets[t].tolerance, 2);
  return result;
}

namespace {

bool is_met(const MatchTarget& target, double reached) {
  return std::abs(reached - target.value) <= target.tolerance;
}

/// Cells and metrics with at least two methods, in which the methods stand as published.
std::pair<std::vector<std::string>, std::size_t> published_orders(const Match& match,
                                                                  const MatchResult& result) {
  std::map<std::pair<std::string, std::size_t>, std::vector<std::size_t>> groups;
  for (std::size_t t = 0; t < match.targets.size(); ++t)
    groups[{match.targets[t].cell, match.targets[t].metric}].push_back(t);
  std::vector<std::string> kept;
  std::size_t of = 0;
  for (const auto& [group, members] : groups) {
    if (members.size() < 2) continue;
    ++of;
    bool same = true;
    for (const auto a : members)
      for (const auto b : members)
        same = same && (!(match.targets[a].value < match.targets[b].value) ||
                        result.reached[a] < result.reached[b]);
    if (same) kept.push_back(metric_types().ids()[group.second] + " " + group.first);
  }
  return {kept, of};
}

Table match_summary(const Match& match, const MatchResult& result) {
  std::int64_t met = 0;
  for (std::size_t t = 0; t < match.targets.size(); ++t)
    met += is_met(match.targets[t], result.reached[t]);
  const auto [kept, orders] = published_orders(match, result);
  Table table{.title = match.title + ": in short",
              .columns = {{"reading", ""},
                          {"met", ""},
                          {"of", ""},
                          {"in the published order", ""},
                          {"orders", ""},
                          {"sum of squares", "tolerances"}}};
  table.rows.push_back({match.title, met, static_cast<std::int64_t>(match.targets.size()),
                        fmt::format("{}", fmt::join(kept, ", ")), static_cast<std::int64_t>(orders),
                        result.objective});
  return table;
}

}  // namespace

std::vector<Table> match_tables(const Match& match, const MatchResult& result) {
  Table found{.title = match.title + ": scenario found",
              .columns = {{"parameter", ""}, {"value", ""}, {"searched from", ""}, {"to", ""}}};
  for (std::size_t i = 0; i < match.free.size(); ++i)
    found.rows.push_back(
        {match.free[i].path, result.values[i], match.free[i].range.low, match.free[i].range.high});
  Table targets{.title = match.title + ": published and reached",
                .columns = {{"cell", ""},
                            {"method", ""},
                            {"metric", ""},
                            {"published", ""},
                            {"reached", ""},
                            {"± 95 %", ""},
                            {"spread of one run", ""},
                            {"deviation", "tolerances"},
                            {"met", ""}}};
  const auto metrics = metric_types().ids();
  int met = 0;
  for (std::size_t t = 0; t < match.targets.size(); ++t) {
    const auto& target = match.targets[t];
    const double deviation = (result.reached[t] - target.value) / target.tolerance;
    met += is_met(target, result.reached[t]);
    targets.rows.push_back({target.cell, target.method, metrics[target.metric], target.value,
                            result.reached[t], cell(result.half_widths[t]), cell(result.spreads[t]),
                            deviation,
                            std::string(is_met(target, result.reached[t]) ? "yes" : "no")});
  }
  targets.notes.push_back(
      fmt::format("{} of {} within their tolerance; sum of squared deviations {:.4g}", met,
                  match.targets.size(), result.objective));
  return {found, targets, match_summary(match, result)};
}

}  // namespace gyrostat
