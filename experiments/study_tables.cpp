#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "analysis/error_series.hpp"
#include "analysis/errors.hpp"
#include "analysis/spectra/allan.hpp"
#include "analysis/statistics/paired.hpp"
#include "analysis/statistics/summary.hpp"
#include "experiments/error_tables.hpp"
#include "experiments/page.hpp"
#include "experiments/sensitivity.hpp"
#include "experiments/study_store.hpp"

namespace gyrostat {
namespace {

/// The cells of a study that a page asked for, run once each.
class Results {
 public:
  Results(const std::string& path, const RunCell& run) : study_(read_study(path)), run_(run) {}

  const Study& study() const { return study_; }

  const CellResult& of(const Cell& cell) {
    const auto index = static_cast<std::size_t>(&cell - study_.cells.data());
    if (!done_.contains(index)) done_.emplace(index, run_(study_, cell));
    return done_.at(index);
  }

 private:
  Study study_;
  RunCell run_;
  std::map<std::size_t, CellResult> done_;
};

/// What every kind of table may be asked.
struct Request {
  std::string name, kind, title;
  std::vector<const Cell*> cells;
  std::vector<std::string> methods;  ///< empty: all of each cell
  std::vector<std::size_t> metrics;
  std::vector<std::string> than;
  std::string quantity;
  std::uint32_t trial = 0;
  std::size_t points = 120;
};

std::vector<std::string> texts(JsonObject& object, const std::string& key) {
  std::vector<std::string> all;
  for (const auto& [value, place] : object.list(key)) {
    if (!value->is_string()) throw InputError(place, "a text is needed here");
    all.push_back(value->get<std::string>());
  }
  return all;
}

/// Cells by name, or by the name of the grid that they came of.
std::vector<const Cell*> chosen_cells(const Study& study, JsonObject& object) {
  std::vector<const Cell*> cells;
  const auto names = texts(object, "cells");
  if (names.empty())
    for (const auto& cell : study.cells) cells.push_back(&cell);
  for (const auto& name : names) {
    const auto before = cells.size();
    for (const auto& cell : study.cells)
      if (cell.name == name || cell.name.starts_with(name + "[")) cells.push_back(&cell);
    if (cells.size() > before) continue;
    std::vector<std::string> known;
    for (const auto& cell : study.cells) known.push_back(cell.name);
    throw InputError(object.place_of("cells"), unknown_name("cell", name, known));
  }
  return cells;
}

std::size_t index_of(const Cell& cell, const std::string& method, const std::string& place) {
  std::vector<std::string> ids;
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    if (cell.methods[m].id == method) return m;
    ids.push_back(cell.methods[m].id);
  }
  throw InputError(place, unknown_name("method", method, ids));
}

Request read_request(const Study& study, const Json& json, const std::string& place) {
  JsonObject object(json, place);
  Request request;
  request.name = object.required_text("name");
  request.kind = object.required_text("kind");
  request.title = object.text("title", request.name);
  request.cells = chosen_cells(study, object);
  request.methods = texts(object, "methods");
  request.than = texts(object, "than");
  for (const auto& metric : texts(object, "metrics"))
    request.metrics.push_back(metric_named(metric, object.place_of("metrics")));
  if (request.metrics.empty()) request.metrics.push_back(metric_named("bias_rmse", place));
  request.quantity = object.text("quantity", "rate");
  request.trial =
      static_cast<std::uint32_t>(object.number("trial", 0, Range{0, 1e6, false, false, true}, ""));
  request.points = static_cast<std::size_t>(object.number("points", 120, ranges::count, ""));
  object.finish();
  for (const auto* cell : request.cells) {
    for (const auto& method : request.methods) index_of(*cell, method, place);
    for (const auto& method : request.than) index_of(*cell, method, place);
  }
  return request;
}

std::vector<std::size_t> methods_of(const Request& request, const Cell& cell) {
  std::vector<std::size_t> methods;
  for (const auto& id : request.methods) methods.push_back(index_of(cell, id, request.name));
  if (methods.empty())
    for (std::size_t m = 0; m < cell.methods.size(); ++m) methods.push_back(m);
  return methods;
}

std::string unit_of(std::size_t metric) {
  std::string unit;
  std::size_t m = 0;
  Metrics::for_each([&](auto plugin) {
    if (m++ == metric) unit = std::string(decltype(plugin)::type::unit);
  });
  return unit == "1" ? "" : unit;
}

std::int64_t trials_with_breakdown(const CellResult& result, std::size_t method) {
  return std::count_if(result.trials.begin(), result.trials.end(), [&](const auto& record) {
    return record && record->outcomes[method].breakdowns() > 0;
  });
}

/// One row a cell and method: the mean of each metric with its interval.
Table means(const Request& request, Results& results) {
  Table table{
      .title = request.title, .columns = {{"cell", ""}, {"method", ""}}, .rows = {}, .notes = {}};
  const auto metrics = Metrics::ids();
  for (const std::size_t metric : request.metrics) {
    table.columns.push_back({metrics[metric], unit_of(metric)});
    table.columns.push_back({"± " + metrics[metric], unit_of(metric)});
  }
  table.columns.push_back({"broke down", "trials"});
  table.columns.push_back({"trials", ""});
  for (const auto* cell : request.cells) {
    const auto& result = results.of(*cell);
    for (const std::size_t m : methods_of(request, *cell)) {
      auto& row = table.rows.emplace_back(std::vector<TableCell>{cell->name, cell->methods[m].id});
      for (const std::size_t metric : request.metrics) {
        const auto s = summarise(metric_values(result, m, metric));
        row.push_back(gyrostat::cell(s.mean));
        row.push_back(gyrostat::cell(s.half_width_95));
      }
      row.emplace_back(trials_with_breakdown(result, m));
      row.emplace_back(static_cast<std::int64_t>(result.finished()));
    }
  }
  table.notes.push_back(
      "mean over trials ± 95 % (Student t); every trial counts, broken down or not");
  return table;
}

/// One row a cell, one column a method, and who is lowest.
Table map_of(const Request& request, Results& results) {
  const std::size_t metric = request.metrics.front();
  const Cell& first = *request.cells.front();
  Table table{.title = request.title, .columns = {{"cell", ""}}, .rows = {}, .notes = {}};
  const auto methods = methods_of(request, first);
  for (const std::size_t m : methods)
    table.columns.push_back({first.methods[m].id, unit_of(metric)});
  table.columns.push_back({"lowest", ""});
  table.columns.push_back({"not separable from it", ""});
  table.columns.push_back({"broke down", "trials"});
  std::size_t rivals = 0;
  for (const std::size_t m : methods) rivals += first.methods[m].filter != "oracle";
  const std::size_t family = request.cells.size() * rivals * (rivals - 1) / 2;
  for (const auto* cell : request.cells) {
    const auto& result = results.of(*cell);
    const auto own = methods_of(request, *cell);
    auto& row = table.rows.emplace_back(std::vector<TableCell>{cell->name});
    std::vector<std::size_t> judged;
    std::vector<std::vector<double>> values;
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t m : own) {
      values.push_back(metric_values(result, m, metric));
      const double mean = summarise(values.back()).mean;
      row.push_back(gyrostat::cell(mean));
      if (cell->methods[m].filter == "oracle" || !(mean < least)) continue;
      least = mean;
      best = values.size() - 1;
    }
    std::string tied, broken;
    for (const std::size_t m : own)
      if (const auto trials = trials_with_breakdown(result, m); trials > 0)
        broken += fmt::format("{}{} {}", broken.empty() ? "" : ", ", cell->methods[m].id, trials);
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (i == best || cell->methods[own[i]].filter == "oracle") continue;
      if (paired_difference(values[i], values[best], family).separable) continue;
      tied += (tied.empty() ? "" : ", ") + cell->methods[own[i]].id;
    }
    row.push_back(cell->methods[own[best]].id);
    row.push_back(tied.empty() ? TableCell() : TableCell(tied));
    row.push_back(broken.empty() ? TableCell(std::int64_t{0}) : TableCell(broken));
  }
  table.notes.push_back(
      fmt::format("mean {} over {} trials a cell, all methods on the same signals; lowest: of all "
                  "but the oracle; "
                  "separable: paired, 95 % simultaneous over all pairs and cells (Bonferroni, {})",
                  Metrics::ids()[metric], results.of(first).finished(), family));
  return table;
}

/// `methods` each against each of `than`, paired, in each cell.
Table versus(const Request& request, Results& results) {
  Table table{.title = request.title,
              .columns = {{"cell", ""},
                          {"method", ""},
                          {"than", ""},
                          {"ratio", ""},
                          {"difference", unit_of(request.metrics.front())},
                          {"± 95 % simultaneous", unit_of(request.metrics.front())},
                          {"verdict", ""},
                          {"broke down", "trials"},
                          {"than broke down", "trials"}},
              .rows = {},
              .notes = {}};
  std::size_t family = 0;
  for (const auto* cell : request.cells)
    for (const std::size_t m : methods_of(request, *cell))
      for (const auto& than : request.than) family += cell->methods[m].id != than;
  const std::size_t metric = request.metrics.front();
  for (const auto* cell : request.cells) {
    const auto& result = results.of(*cell);
    for (const std::size_t m : methods_of(request, *cell))
      for (const auto& than : request.than) {
        if (cell->methods[m].id == than) continue;
        const std::size_t other = index_of(*cell, than, request.name);
        const auto ours = metric_values(result, m, metric);
        const auto theirs = metric_values(result, other, metric);
        const auto d = paired_difference(ours, theirs, family);
        std::string verdict = "not separable";
        if (d.separable)
          verdict = d.mean < 0.0 ? "lower" : "higher";
        else if (!std::isnan(d.trials_needed))
          verdict += fmt::format(", about {:.0f} more trials would tell",
                                 std::max(0.0, d.trials_needed - static_cast<double>(d.count)));
        table.rows.push_back({cell->name, cell->methods[m].id, than,
                              gyrostat::cell(summarise(ours).mean / summarise(theirs).mean),
                              gyrostat::cell(d.mean), gyrostat::cell(d.half_width), verdict,
                              trials_with_breakdown(result, m),
                              trials_with_breakdown(result, other)});
      }
  }
  table.notes.push_back(
      fmt::format("{}, paired by trial; intervals simultaneous over the {} rows "
                  "(Bonferroni)",
                  Metrics::ids()[metric], family));
  return table;
}

/// The tracks of one trial's methods.
struct Played {
  Series series;
  std::vector<std::string> ids;
  std::vector<Track> tracks;
};

Played play(const Request& request, Results& results, const Cell& plain) {
  const auto& result = results.of(plain);
  const Cell cell = with_tuned(plain, result.tuned);
  Played played;
  Series buffer;
  cell.make_trial(results.study().seed, request.trial, played.series);
  for (const std::size_t m : methods_of(request, cell)) {
    const auto& method = cell.methods[m];
    played.ids.push_back(method.id);
    track_method(method, told_parameters(cell, method, result.calibration, played.series),
                 played.series, played.tracks.emplace_back());
  }
  return played;
}

std::vector<double> traced(const Request& request, const Series& series, const Track& track) {
  if (request.quantity == "heading") return heading_errors_deg(series, track);
  if (request.quantity == "estimate") return track.estimate_dps;
  std::vector<double> values(series.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = rate_error_dps(series, track, i);
  return values;
}

void add_binned(Table& table, const std::string& name, const std::string& unit, bool spread,
                const std::vector<double>& values, std::size_t points) {
  table.columns.push_back({name, unit});
  if (spread) table.columns.push_back({"std of " + name, unit});
  for (std::size_t b = 0; b < points; ++b) {
    const std::size_t from = b * values.size() / points, to = (b + 1) * values.size() / points;
    const auto moments = error_moments(to - from, [&](std::size_t i) { return values[from + i]; });
    table.rows[b].push_back(gyrostat::cell(moments.mean));
    if (spread) table.rows[b].push_back(gyrostat::cell(moments.std));
  }
}

/// One trial over time, in bins: the mean (and of rates the spread) of each method's error.
Table traces(const Request& request, Results& results) {
  const Cell& cell = *request.cells.front();
  const auto played = play(request, results, cell);
  const std::size_t points = std::min(request.points, played.series.size());
  Table table{.title = request.title, .columns = {}, .rows = {}, .notes = {}};
  table.rows.resize(points);
  const bool heading = request.quantity == "heading", rate = request.quantity == "rate";
  add_binned(table, "t", "s", false, played.series.t_s, points);
  if (!played.series.temperature_C.empty())
    add_binned(table, "temperature", "°C", false, played.series.temperature_C, points);
  if (!cell.recording && !heading) {
    std::vector<double> truth(played.series.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
      truth[i] = played.series.thermal_bias_dps[i] + played.series.random_error_dps[i];
    add_binned(table, "truth", "dps", false, truth, points);
  }
  for (std::size_t m = 0; m < played.ids.size(); ++m)
    add_binned(table, played.ids[m], heading ? "deg" : "dps", rate,
               traced(request, played.series, played.tracks[m]), points);
  table.notes.push_back(fmt::format("{}, trial {}: {} of each of {} intervals", cell.name,
                                    request.trial, rate ? "mean and standard deviation" : "mean",
                                    points));
  return table;
}

/// Allan deviation of one trial's compensated rates, with confidence bands.
Table allan(const Request& request, Results& results) {
  const Cell& cell = *request.cells.front();
  const auto played = play(request, results, cell);
  Table table{.title = request.title, .columns = {{"tau", "s"}}, .rows = {}, .notes = {}};
  for (std::size_t m = 0; m < played.ids.size(); ++m) {
    std::vector<double> error(played.series.size());
    for (std::size_t i = 0; i < error.size(); ++i)
      error[i] = rate_error_dps(played.series, played.tracks[m], i);
    const auto points = overlapping_allan_deviation(error, played.series.rate_hz());
    table.rows.resize(points.size());
    for (const char* prefix : {"", "lower ", "upper "})
      table.columns.push_back({prefix + played.ids[m], "dps"});
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (m == 0) table.rows[p].push_back(points[p].tau_s);
      for (const double v : {points[p].deviation, points[p].lower, points[p].upper})
        table.rows[p].push_back(v);
    }
  }
  table.notes.push_back(
      fmt::format("{}, trial {}; lower and upper bound the 95 % confidence interval "
                  "by equivalent degrees of freedom",
                  cell.name, request.trial));
  return table;
}

/// The tuned values of all cells, one below the other.
Table tuned(const Request& request, Results& results) {
  Table table{.title = request.title,
              .columns = {{"cell", ""},
                          {"method", ""},
                          {"parameter", ""},
                          {"tuned", ""},
                          {"before", ""},
                          {"broke down before", ""},
                          {"after", ""},
                          {"broke down after", ""}},
              .rows = {},
              .notes = {}};
  for (const auto* cell : request.cells) {
    for (auto& row : tuning_table(*cell, results.of(*cell).tuned).rows) {
      row.insert(row.begin(), TableCell(cell->name));
      table.rows.push_back(std::move(row));
    }
    table.notes = {fmt::format(
        "before, after: mean {} over {} trials of their own; {} evaluations each",
        Metrics::ids()[cell->tuning.metric], cell->tuning.trials, cell->tuning.evaluations)};
  }
  return table;
}

/// The elasticities, mu* and sigma, or indices of the design that the chosen cells are points of.
Table sensitivity(const Request& request, Results& results) {
  Study study = results.study();
  std::erase_if(study.designs, [&](const Design& design) {
    return &results.study().cells[design.first_cell] != request.cells.front();
  });
  const auto trials = [&](std::size_t cell, const auto& visit) {
    const auto& records = results.of(results.study().cells[cell]).trials;
    for (std::uint32_t t = 0; t < records.size(); ++t)
      if (records[t]) visit(t, row_of(0, t, *records[t]).outcomes);
  };
  const auto found =
      sensitivities(study, CellTrials(trials), {.metric = Metrics::ids()[request.metrics.front()]});
  auto tables = sensitivity_tables(found, study);
  if (tables.empty())
    throw InputError(request.name,
                     "the chosen cells are no one_at_a_time, morris or saltelli design");
  tables.front().title = request.title;
  return tables.front();
}

}  // namespace

std::vector<NamedTable> study_tables(const std::string& path,
                                     const std::vector<std::pair<const Json*, std::string>>& specs,
                                     const RunCell& run) {
  static const std::vector<std::pair<std::string, Table (*)(const Request&, Results&)>> kinds = {
      {"means", means}, {"map", map_of},  {"versus", versus},          {"traces", traces},
      {"allan", allan}, {"tuned", tuned}, {"sensitivity", sensitivity}};
  Results results(path, run);
  std::vector<Request> requests;
  for (const auto& [spec, place] : specs) {
    requests.push_back(read_request(results.study(), *spec, place));
    std::vector<std::string> names;
    for (const auto& [name, make] : kinds) names.push_back(name);
    if (std::find(names.begin(), names.end(), requests.back().kind) == names.end())
      throw InputError(place + ".kind", unknown_name("kind of table", requests.back().kind, names));
  }
  std::vector<NamedTable> tables;
  for (const auto& request : requests)
    for (const auto& [name, make] : kinds)
      if (name == request.kind) tables.push_back({request.name, make(request, results)});
  return tables;
}

}  // namespace gyrostat
