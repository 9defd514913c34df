#include <gyrostat/experiments/pages/matching.hpp>

#include <filesystem>

#include <fmt/format.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/statistics/summary.hpp>
#include <gyrostat/experiments/run/runner.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/json_path.hpp>

namespace gyrostat {
namespace {

/// The study at the given values of the free parameters.
Study study_at(const Match& match, const Json& json, const std::vector<double>& values) {
  Json varied = json;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (auto& cell : varied["cells"])
      set_at(cell, match.free[i].first, values[i], match.title + ": free");
  return parse_study(varied, match.study_path);
}

/// The trials of every target, from one run of the study.
std::vector<Summary> reached_by(const Match& match, Study study, std::uint32_t trials) {
  std::vector<Summary> reached(match.targets.size());
  for (auto& cell : study.cells) {
    cell.trials = trials;
    const auto result = run_cell(cell, study.seed, {});
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
    sum += deviation * deviation;
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

}  // namespace

Match read_match(const std::string& path) {
  const Json json = read_json(path);
  JsonObject object(json, path + ":");
  Match match;
  match.title = object.text("title", path);
  const auto file = object.text("study", "");
  match.study_path = (std::filesystem::path(path).parent_path() / file).lexically_normal().string();
  match.study = read_json(match.study_path);
  const Study study = parse_study(match.study, match.study_path);
  match.trials = static_cast<std::uint32_t>(object.number("trials", 20, ranges::count, "trials"));
  match.evaluations = static_cast<int>(object.number("evaluations", 200, ranges::count, ""));
  match.rounds = static_cast<int>(object.number("rounds", 2, ranges::count, ""));
  for (const auto& [value, place] : object.list("free")) {
    JsonObject entry(*value, place);
    const double low = entry.number("low", 0.0, ranges::any, "");
    const double high = entry.number("high", 1.0, ranges::any, "");
    if (!(low < high)) throw InputError(place, "\"low\" is not below \"high\"");
    match.free.emplace_back(entry.text("path", ""), SearchRange{low, high});
    entry.finish();
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

MatchResult run_match(const Match& match, std::ostream& log) {
  std::vector<SearchRange> ranges;
  MatchResult result;
  for (const auto& [path, range] : match.free) {
    ranges.push_back(range);
    result.values.push_back(range.at(0.5));
  }
  Json fixed = match.study;
  for (int round = 0; round < match.rounds; ++round) {
    fixed = with_tuning(match, match.study, result.values);
    const auto found = box_search(ranges, match.evaluations, [&](const auto& values) {
      return distance(match, reached_by(match, study_at(match, fixed, values), match.trials));
    });
    result.values = found.values;
    log << fmt::format("round {}: distance {:.4g} after {} evaluations\n", round + 1,
                       found.objective, found.evaluations);
  }
  result.study = with_tuning(match, match.study, result.values);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    for (auto& cell : result.study["cells"])
      set_at(cell, match.free[i].first, result.values[i], match.title);
  // Another seed: the numbers that are shown did not choose the scenario.
  Study fresh = study_at(match, result.study, result.values);
  fresh.seed += 1;
  const auto reached = reached_by(match, fresh, 10 * match.trials);
  for (const auto& summary : reached) {
    result.reached.push_back(summary.mean);
    result.half_widths.push_back(summary.half_width_95);
    result.spreads.push_back(summary.std);
  }
  result.objective = distance(match, reached);
  return result;
}

std::vector<Table> match_tables(const Match& match, const MatchResult& result) {
  Table found{.title = match.title + ": scenario found",
              .columns = {{"parameter", ""}, {"value", ""}, {"searched from", ""}, {"to", ""}}};
  for (std::size_t i = 0; i < match.free.size(); ++i)
    found.rows.push_back({match.free[i].first, result.values[i], match.free[i].second.low,
                          match.free[i].second.high});
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
    met += std::abs(deviation) <= 1.0;
    targets.rows.push_back({target.cell, target.method, metrics[target.metric], target.value,
                            result.reached[t], cell(result.half_widths[t]), cell(result.spreads[t]),
                            deviation, std::string(std::abs(deviation) <= 1.0 ? "yes" : "no")});
  }
  targets.notes.push_back(
      fmt::format("{} of {} within their tolerance; sum of squared deviations {:.4g}", met,
                  match.targets.size(), result.objective));
  return {found, targets};
}

}  // namespace gyrostat
