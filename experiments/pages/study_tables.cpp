#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/statistics/paired.hpp>
#include <gyrostat/analysis/statistics/summary.hpp>
#include <gyrostat/experiments/findings/error_tables.hpp>
#include <gyrostat/experiments/findings/sensitivity.hpp>
#include <gyrostat/experiments/pages/trial_tables.hpp>
#include <gyrostat/experiments/run/study_store.hpp>

namespace gyrostat {
namespace tabling {
namespace {

std::string unit_of(std::size_t metric) {
  const std::string unit(metric_types()[metric].unit);
  return unit == "1" ? "" : unit;
}

std::int64_t trials_with_breakdown(const CellResult& result, std::size_t method) {
  return std::count_if(result.trials.begin(), result.trials.end(), [&](const auto& record) {
    return record && record->of(method).broke_down();
  });
}

/// One row a cell and method: the mean of each metric with its interval.
Table means(const Request& request, Results& results) {
  Table table{.title = request.title, .columns = {{"cell", ""}, {"method", ""}}};
  const auto metrics = metric_types().ids();
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
      "mean over trials ± 95 %, right at both ends though values are skewed (Hall); every trial "
      "counts, broken down or not");
  return table;
}

/// One row a cell, one column a method, and who is lowest.
Table map_of(const Request& request, Results& results) {
  const std::size_t metric = request.metrics.front();
  const Cell& first = *request.cells.front();
  Table table{.title = request.title, .columns = {{"cell", ""}}};
  const auto methods = methods_of(request, first);
  for (const std::size_t m : methods)
    table.columns.push_back({first.methods[m].id, unit_of(metric)});
  table.columns.push_back({"lowest", ""});
  table.columns.push_back({"not separable from it", ""});
  table.columns.push_back({"broke down", "trials"});
  std::size_t rivals = 0;
  for (const std::size_t m : methods) rivals += !first.methods[m].role().is_bound();
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
      if (cell->methods[m].role().is_bound() || !(mean < least)) continue;
      least = mean;
      best = values.size() - 1;
    }
    std::string tied, broken;
    for (const std::size_t m : own)
      if (const auto trials = trials_with_breakdown(result, m); trials > 0)
        broken += fmt::format("{}{} {}", broken.empty() ? "" : ", ", cell->methods[m].id, trials);
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (i == best || cell->methods[own[i]].role().is_bound()) continue;
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
                  metric_types()[metric].id, results.of(first).finished(), family));
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
                          {"from", unit_of(request.metrics.front())},
                          {"to", unit_of(request.metrics.front())},
                          {"verdict", ""},
                          {"broke down", "trials"},
                          {"than broke down", "trials"}}};
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
                              gyrostat::cell(d.mean), gyrostat::cell(d.low), gyrostat::cell(d.high),
                              verdict, trials_with_breakdown(result, m),
                              trials_with_breakdown(result, other)});
      }
  }
  table.notes.push_back(
      fmt::format("{}, paired by trial; from, to: 95 %, simultaneous over the {} rows "
                  "(Bonferroni)",
                  metric_types()[metric].id, family));
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
                          {"broke down after", ""}}};
  for (const auto* cell : request.cells) {
    for (auto& row : tuning_table(*cell, results.of(*cell).tuned).rows) {
      row.insert(row.begin(), TableCell(cell->name));
      table.rows.push_back(std::move(row));
    }
    table.notes = {fmt::format(
        "before, after: mean {} over {} trials of their own; {} evaluations each",
        metric_types()[cell->tuning.metric].id, cell->tuning.trials, cell->tuning.evaluations)};
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
      if (records[t]) visit(t, records[t]->numbers);
  };
  const auto found = sensitivities(study, CellTrials(trials),
                                   {.metric = metric_types().ids()[request.metrics.front()]});
  auto tables = sensitivity_tables(found, study);
  if (tables.empty())
    throw InputError(request.name,
                     "the chosen cells are no one_at_a_time, morris, saltelli or surrogate design");
  tables.front().title = request.title;
  return tables.front();
}

}  // namespace
}  // namespace tabling

std::vector<NamedTable> study_tables(const std::string& path,
                                     const std::vector<std::pair<const Json*, std::string>>& specs,
                                     const RunCell& run) {
  using namespace tabling;
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
