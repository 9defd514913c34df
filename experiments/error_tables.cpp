#include "experiments/error_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/statistics/paired.hpp"
#include "analysis/statistics/summary.hpp"

namespace gyrostat {
namespace {

std::vector<double> values_of(const CellResult& result, std::size_t method,
                              std::string_view metric) {
  return metric_values(result, method, metric_named(std::string(metric), "tables"));
}

Summary summary_of(const CellResult& result, std::size_t method, std::string_view metric) {
  return summarise(values_of(result, method, metric));
}

struct Failures {
  std::size_t diverged = 0;
  std::size_t broken_down = 0;
  std::size_t breakdown_steps = 0;
};

Failures failures_of(const CellResult& result, std::size_t method) {
  Failures failures;
  for (const auto& record : result.trials) {
    if (!record) continue;
    const auto& outcome = record->outcomes[method];
    failures.diverged += outcome.diverged;
    failures.broken_down += outcome.breakdowns() > 0;
    failures.breakdown_steps += outcome.breakdowns();
  }
  return failures;
}

TableCell out_of(std::size_t count, std::size_t total) { return fmt::format("{}/{}", count, total); }

Table metric_table(const Cell& cell, const CellResult& result, std::string_view metric,
                   std::string_view title, std::string_view unit) {
  const std::string u(unit);
  Table table{.title = fmt::format("{}: {}", cell.name, title),
              .columns = {{"method", ""}, {"mean", u}, {"± 95 %", u}, {"std", u}, {"median", u},
                          {"95 % of |·|", u}, {"worst |·|", u}, {"diverged", ""}, {"broke down", ""}},
              .rows = {}, .notes = {}};
  const std::size_t total = result.finished();
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    const auto s = summary_of(result, m, metric);
    const auto failures = failures_of(result, m);
    table.rows.push_back({cell.methods[m].id, gyrostat::cell(s.mean), gyrostat::cell(s.half_width_95),
                          gyrostat::cell(s.std), gyrostat::cell(s.median),
                          gyrostat::cell(s.percentile_95), gyrostat::cell(s.worst),
                          out_of(failures.diverged, total), out_of(failures.broken_down, total)});
  }
  return table;
}

/// The method, besides the oracle, with the smallest mean of `metric`.
std::size_t best_method(const Cell& cell, const CellResult& result, std::string_view metric) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    const double mean = summary_of(result, m, metric).mean;
    if (cell.methods[m].filter == "oracle" || !(mean < least)) continue;
    least = mean;
    best = m;
  }
  return best;
}

Table comparison_table(const Cell& cell, const CellResult& result, std::string_view metric,
                       std::string_view title, const std::string& unit) {
  const std::size_t best = best_method(cell, result, metric);
  const std::size_t family = cell.methods.size() * (cell.methods.size() - 1) / 2;
  Table table{.title = fmt::format("{}: {}, minus that of {}, paired by trial", cell.name, title,
                                   cell.methods[best].id),
              .columns = {{"method", ""}, {"difference", unit}, {"± 95 % simultaneous", unit},
                          {"p adjusted", "1"}, {"verdict", ""}},
              .rows = {}, .notes = {}};
  const auto reference = values_of(result, best, metric);
  constexpr double rounding = 1e-9;
  const double scale = summarise(reference).mean;
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    if (m == best) continue;
    const auto d = paired_difference(values_of(result, m, metric), reference, family);
    std::string verdict = "not separable";
    if (std::abs(d.mean) <= rounding * scale) verdict = "equal to rounding";
    else if (d.separable) verdict = d.mean > 0.0 ? "worse" : "better";
    else if (!std::isnan(d.trials_needed))
      verdict += fmt::format("; about {:.0f} trials would tell", d.trials_needed);
    table.rows.push_back({cell.methods[m].id, gyrostat::cell(d.mean), gyrostat::cell(d.half_width),
                          gyrostat::cell(d.p_adjusted), verdict});
  }
  table.notes.push_back(
      fmt::format("Bonferroni over all {} pairs of methods, so the pair may be picked after looking",
                  family));
  return table;
}

/// How an interval of a normalised squared error reads.
std::string verdict(const Summary& s) {
  if (!(s.half_width_95 >= 0.0)) return "–";
  if (s.mean - s.half_width_95 > 1.0) return "over-confident";
  if (s.mean + s.half_width_95 < 1.0) return "conservative";
  return "consistent";
}

Table consistency_table(const Cell& cell, const CellResult& result) {
  Table table{.title = cell.name + ": consistency (1 is what the filter itself claims)",
              .columns = {{"method", ""}, {"NIS", "1"}, {"± 95 %", "1"}, {"innovations", ""},
                          {"NEES", "1"}, {"± 95 %", "1"}, {"covariance", ""},
                          {"breakdown steps", ""}},
              .rows = {}, .notes = {}};
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    const auto nis = summary_of(result, m, "nis"), nees = summary_of(result, m, "nees");
    table.rows.push_back({cell.methods[m].id, gyrostat::cell(nis.mean),
                          gyrostat::cell(nis.half_width_95), verdict(nis), gyrostat::cell(nees.mean),
                          gyrostat::cell(nees.half_width_95), verdict(nees),
                          static_cast<std::int64_t>(failures_of(result, m).breakdown_steps)});
  }
  return table;
}

}  // namespace

Table calibration_table(const Cell& cell, const CellResult& result) {
  const auto& fit = result.calibration;
  Table table{.title = fmt::format("{}: parameters fitted on {}", cell.name,
                                   cell.recording ? "the recording before the trials"
                                                  : "a calibration signal of the same scenario"),
              .columns = {{"parameter", ""}, {"unit", ""}, {"fitted", ""}, {"standard error", ""},
                          {"true", ""}},
              .rows = {}, .notes = {}};
  const auto add = [&](const auto& fitted, const auto& errors, const auto& truth) {
    using P = std::remove_cvref_t<decltype(fitted)>;
    for (const auto& f : P::fields())
      table.rows.push_back({std::string(f.name), std::string(f.unit), fitted.*(f.member),
                            errors.*(f.member),
                            cell.recording ? TableCell() : TableCell(truth.*(f.member))});
  };
  add(fit.random_error.parameters, fit.random_error.standard_errors, cell.scenario.random_error);
  if (fit.thermal)
    add(fit.thermal->parameters, fit.thermal->standard_errors, cell.scenario.thermal_drift);
  table.notes.push_back("random error: " + fit.random_error.message);
  if (fit.thermal) table.notes.push_back("thermal drift: " + fit.thermal->message);
  if (cell.calibration.each_trial) {
    std::size_t failed = 0;
    for (const auto& record : result.trials) failed += record && !record->calibration_converged;
    table.notes.push_back(fmt::format("this is trial 0's; each trial has its own, of which {} of {} "
                                      "did not converge", failed, result.finished()));
  }
  return table;
}

Table tuning_table(const Cell& cell, const CellResult& result) {
  const auto metric = Metrics::ids()[cell.tuning.metric];
  Table table{.title = fmt::format("{}: tuned on {} trials of their own, {} evaluations each", cell.name,
                                   cell.tuning.trials, cell.tuning.evaluations),
              .columns = {{"method", ""}, {"parameter", ""}, {"tuned", ""},
                          {metric + " before", ""}, {metric + " after", ""}},
              .rows = {}, .notes = {}};
  for (std::size_t m = 0; m < result.tuned.size(); ++m)
    for (const auto& [name, value] : result.tuned[m].values)
      table.rows.push_back({cell.methods[m].id, name, value,
                            gyrostat::cell(result.tuned[m].objective_before),
                            gyrostat::cell(result.tuned[m].objective_after)});
  return table;
}

std::vector<Table> error_tables(const Cell& cell, const CellResult& result) {
  struct Shown {
    const char* metric;
    const char* title;
    const char* unit;
  };
  static constexpr Shown shown[] = {
      {"bias_rmse", "bias estimation error (estimate - drift - random error), RMSE over time", "dps"},
      {"log_score", "logarithmic score of the innovations (small: foretells the gyro well)", "nat"},
      {"rate_rmse", "compensated rate error, RMSE over time", "dps"},
      {"rate_std", "compensated rate error, standard deviation over time", "dps"},
      {"rate_mean", "compensated rate error, mean over time", "dps"},
      {"heading_end", "heading error at the end", "deg"},
      {"heading_range", "heading error, highest minus lowest", "deg"}};
  const bool truth = !cell.recording;
  std::vector<Table> tables;
  for (const auto& [metric, title, unit] : shown)
    if (std::string_view(metric) != (truth ? "log_score" : "bias_rmse"))
      tables.push_back(metric_table(cell, result, metric, title, unit));
  tables.front().notes.push_back(
      fmt::format("statistics over {} of {} trials; diverged: bias RMSE above {} x that of no "
                  "compensation; broke down: a step had to be left out. Both stay in every mean.",
                  result.finished(), cell.trials, divergence_ratio));
  tables[1].notes.push_back(
      "the white noise is part of it: an estimate that follows the noise makes it small, so it can "
      "lie below the oracle's, and only the bias estimation error tells who knows the bias");
  tables.insert(tables.begin() + 1,
                truth ? comparison_table(cell, result, "bias_rmse",
                                         "RMSE of the bias estimation error", "dps")
                      : comparison_table(cell, result, "log_score",
                                         "logarithmic score of the innovations", "nat"));
  tables.push_back(consistency_table(cell, result));
  return tables;
}

Table timing_table(const Cell& cell, const CellResult& result) {
  Table table{.title = cell.name + ": time per step, metrics included (this run, this machine)",
              .columns = {{"method", ""}, {"time", "ns"}},
              .rows = {}, .notes = {}};
  for (std::size_t m = 0; m < cell.methods.size(); ++m)
    table.rows.push_back({cell.methods[m].id, gyrostat::cell(result.nanoseconds_per_step[m])});
  return table;
}

}  // namespace gyrostat
