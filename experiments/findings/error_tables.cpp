#include <gyrostat/experiments/findings/error_tables.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/findings/consistency.hpp>
#include <gyrostat/experiments/findings/told.hpp>
#include <gyrostat/experiments/run/outcome_numbers.hpp>

namespace gyrostat {
namespace {

Table metric_table(const Cell& cell, const CellSummary& summary, std::string_view metric,
                   std::string_view title, std::string_view unit) {
  const std::string u(unit);
  Table table{.title = fmt::format("{}: {}", cell.name, title),
              .columns = {{"method", ""},
                          {"mean", u},
                          {"± 95 %", u},
                          {"std", u},
                          {"median", u},
                          {"95 % of |·|", u},
                          {"worst |·|", u},
                          {"diverged", ""},
                          {"broke down", ""}}};
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    const auto& s = summary.of(m, metric);
    const auto& method = summary.methods[m];
    table.rows.push_back({cell.methods[m].id, gyrostat::cell(s.mean),
                          gyrostat::cell(s.half_width_95), gyrostat::cell(s.std),
                          gyrostat::cell(s.median), gyrostat::cell(s.percentile_95),
                          gyrostat::cell(s.worst), out_of(method.diverged, summary.finished),
                          out_of(method.broken_down, summary.finished)});
  }
  return table;
}

Table comparison_table(const Cell& cell, const CellSummary& summary) {
  const auto& metric = metric_types().named(judging_metric(cell), "tables");
  const std::string unit(metric.unit);
  const std::size_t best = summary.best;
  const std::size_t pairs = cell.methods.size() * (cell.methods.size() - 1) / 2;
  Table table{.title = fmt::format("{}: {}, minus that of {}, paired by trial", cell.name,
                                   metric.table.difference, cell.methods[best].id),
              .columns = {{"method", ""},
                          {"difference", unit},
                          {"from", unit},
                          {"to", unit},
                          {"p adjusted", "1"},
                          {"verdict", ""},
                          {"diverged", ""},
                          {"broke down", ""}}};
  constexpr double rounding = 1e-9;
  const double scale = summary.of(best, judging_metric(cell)).mean;
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    if (m == best) continue;
    const auto& d = summary.methods[m].difference;
    std::string verdict = "not separable";
    if (std::abs(d.mean) <= rounding * scale)
      verdict = "equal to rounding";
    else if (d.separable)
      verdict = d.mean > 0.0 ? "worse" : "better";
    else if (!std::isnan(d.trials_needed))
      verdict += fmt::format("; about {:.0f} trials would tell", d.trials_needed);
    table.rows.push_back({cell.methods[m].id, gyrostat::cell(d.mean), gyrostat::cell(d.low),
                          gyrostat::cell(d.high), gyrostat::cell(d.p_adjusted), verdict,
                          out_of(summary.methods[m].diverged, summary.finished),
                          out_of(summary.methods[m].broken_down, summary.finished)});
  }
  table.notes.push_back(
      fmt::format("from, to: 95 %, simultaneous over all {} pairs of methods{}, so the pair may be "
                  "picked after looking",
                  pairs, summary.looks > 1.0 ? " and over the looks of the stop rule" : ""));
  return table;
}

}  // namespace

Table calibration_table(const Cell& cell, const Calibration& fit, const CellSummary& summary) {
  Table table{
      .title = fmt::format("{}: parameters fitted on {}", cell.name,
                           cell.recording ? "the recording before the trials"
                                          : "a calibration signal of the same scenario"),
      .columns = {
          {"parameter", ""}, {"unit", ""}, {"fitted", ""}, {"standard error", ""}, {"true", ""}}};
  const bool one_of_many = cell.fleet && cell.calibration.each_trial;
  const bool unknown = cell.recording || one_of_many;
  const auto add = [&](const auto& fitted, const auto& errors, const auto& truth) {
    using P = std::remove_cvref_t<decltype(fitted)>;
    for (const auto& f : P::fields())
      table.rows.push_back({std::string(f.name), std::string(f.unit), fitted.*(f.member),
                            told(errors.*(f.member)),
                            unknown ? TableCell() : TableCell(truth.*(f.member))});
  };
  add(fit.random_error.parameters, fit.random_error.standard_errors, cell.scenario.random_error);
  if (fit.thermal)
    add(fit.thermal->parameters, fit.thermal->standard_errors, cell.scenario.thermal_drift);
  table.notes.push_back("random error: " + fit.random_error.message);
  if (fit.thermal) table.notes.push_back("thermal drift: " + fit.thermal->message);
  if (cell.calibration.each_trial) {
    table.notes.push_back(
        fmt::format("this is trial 0's; each trial has its own, of which {} of {} "
                    "did not converge",
                    summary.unconverged, summary.finished));
  }
  return table;
}

Table tuning_table(const Cell& cell, const std::vector<TunedMethod>& tuned) {
  const auto metric = metric_types()[cell.tuning.metric].id;
  const auto unit = std::string(metric_types()[cell.tuning.metric].unit);
  Table table{
      .title = fmt::format(
          "{}: tuned on {} of their own, {} each", cell.name, counted(cell.tuning.trials, "trial"),
          counted(static_cast<std::uint64_t>(cell.tuning.evaluations), "evaluation")),
      .columns = {{"method", ""},
                  {"parameter", ""},
                  {"tuned", ""},
                  {metric + " before", unit},
                  {"broke down before", ""},
                  {metric + " after", unit},
                  {"broke down after", ""}}};
  for (std::size_t m = 0; m < tuned.size(); ++m)
    for (const auto& [name, value] : tuned[m].values)
      table.rows.push_back({cell.methods[m].id, name, value, gyrostat::cell(tuned[m].before.mean),
                            out_of(tuned[m].before.broken_down, cell.tuning.trials),
                            gyrostat::cell(tuned[m].after.mean),
                            out_of(tuned[m].after.broken_down, cell.tuning.trials)});
  return table;
}

std::vector<Table> error_tables(const Cell& cell, const CellSummary& summary) {
  std::vector<Table> tables;
  for (const auto metric : error_metrics(cell)) {
    const auto& type = metric_types().named(metric, "tables");
    tables.push_back(metric_table(cell, summary, metric, type.table.title, type.unit));
  }
  tables.front().notes.push_back(
      fmt::format("statistics over {} of {}; diverged: bias RMSE above {} x that of no "
                  "compensation; broke down: a step had to be left out. Both stay in every mean.",
                  summary.finished, counted(cell.trials, "trial"), divergence_ratio));
  for (std::size_t m = 0; m < cell.methods.size(); ++m)
    if (const auto thrown = summary.methods[m].thrown; thrown > 0)
      tables.front().notes.push_back(fmt::format("{} threw in {}, without a value",
                                                 cell.methods[m].id, counted(thrown, "trial")));
  tables[1].notes.push_back(
      "the white noise is part of it: an estimate that follows the noise makes it small, so it can "
      "lie below the oracle's, and only the bias estimation error tells who knows the bias");
  tables.insert(tables.begin() + 1, comparison_table(cell, summary));
  tables.push_back(consistency_table(cell, summary));
  return tables;
}

Table timing_table(const Cell& cell, const std::vector<double>& nanoseconds_per_step) {
  Table table{.title = cell.name + ": time per step, metrics included (this run, this machine)",
              .columns = {{"method", ""}, {"time", "ns"}}};
  for (std::size_t m = 0; m < cell.methods.size(); ++m)
    table.rows.push_back({cell.methods[m].id, gyrostat::cell(nanoseconds_per_step[m])});
  return table;
}

}  // namespace gyrostat
