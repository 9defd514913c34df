#include "experiments/cell_summary.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "analysis/statistics/all_pairs.hpp"
#include "analysis/statistics/streamed.hpp"
#include "experiments/trial.hpp"

namespace gyrostat {
namespace {

constexpr std::size_t column_count = metric_count + status_names.size() + 1;

void count_failures(std::span<const double> outcome, MethodSummary& summary) {
  double steps = 0.0, all_steps = 0.0;
  for (std::size_t s = 0; s < status_names.size(); ++s) {
    all_steps += outcome[metric_count + s];
    if (is_breakdown(static_cast<Status>(s))) steps += outcome[metric_count + s];
  }
  summary.thrown += all_steps == 0.0;
  summary.breakdown_steps += static_cast<std::size_t>(steps);
  summary.broken_down += steps > 0.0;
  summary.diverged += outcome.back() != 0.0;
}

std::size_t best_of(const Cell& cell, const CellSummary& summary) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    const double mean = summary.of(m, judging_metric(cell)).mean;
    if (cell.methods[m].filter == "oracle" || !(mean < least)) continue;
    least = mean;
    best = m;
  }
  return best;
}

/// Indices of the metrics that tell of consistency.
std::vector<std::size_t> consistency_metrics() {
  std::vector<std::size_t> indices;
  for (const char* id : {"innovations", "nis", "innovation_lag_1", "ljung_box", "nees", "nees_end",
                         "within_1_sigma", "within_3_sigma", "pit_0", "pit_1", "pit_2", "pit_3",
                         "pit_4", "pit_5", "pit_6", "pit_7", "pit_8", "pit_9"})
    indices.push_back(metric_named(id, "tables"));
  return indices;
}

/// One shown metric of one method.
struct Streamed {
  std::size_t method, metric;
  StreamedSummary summary;
  bool open = true;
};

}  // namespace

const Summary& CellSummary::of(std::size_t method, std::string_view metric) const {
  return methods[method].metrics[metric_named(std::string(metric), "tables")];
}

const Running& CellSummary::running(std::size_t method, std::string_view metric) const {
  return methods[method].running[metric_named(std::string(metric), "tables")];
}

std::string_view judging_metric(const Cell& cell) {
  return cell.recording ? "log_score" : "bias_rmse";
}

std::vector<std::string_view> error_metrics(const Cell& cell) {
  return {judging_metric(cell), "rate_rmse",   "rate_std",
          "rate_mean",          "heading_end", "heading_range"};
}

CellSummary summarise_cell(const Cell& cell, const TrialSource& trials) {
  const std::size_t methods = cell.methods.size();
  CellSummary summary;
  summary.methods.resize(methods);
  for (auto& method : summary.methods) {
    method.metrics.resize(metric_count);
    method.running.resize(metric_count);
  }
  const auto consistency = consistency_metrics();

  auto shown = error_metrics(cell);
  shown.insert(shown.end(), {"nis", "nees"});
  std::vector<Streamed> streams;
  for (std::size_t m = 0; m < methods; ++m)
    for (const auto metric : shown)
      streams.push_back({m, metric_named(std::string(metric), "tables"), {}});

  const std::size_t judging = metric_named(std::string(judging_metric(cell)), "tables");
  std::optional<AllPairs> pairs;
  std::vector<double> judged(methods);
  const auto outcome = [](std::span<const double> outcomes, std::size_t method) {
    return outcomes.subspan(method * column_count, column_count);
  };

  bool more = true;
  for (int pass = 0; more || pass < 3; ++pass) {
    trials([&](bool calibrated, std::span<const double> outcomes) {
      if (pass == 0) {
        ++summary.finished;
        summary.unconverged += !calibrated;
        for (std::size_t m = 0; m < methods; ++m) {
          count_failures(outcome(outcomes, m), summary.methods[m]);
          for (const auto metric : consistency)
            summary.methods[m].running[metric].add(outcome(outcomes, m)[metric]);
        }
      }
      for (auto& stream : streams)
        if (stream.open) stream.summary.add(outcome(outcomes, stream.method)[stream.metric]);
      if (pass != 1 && pass != 2) return;
      for (std::size_t m = 0; m < methods; ++m) judged[m] = outcome(outcomes, m)[judging];
      pairs->add(judged);
    });
    more = false;
    for (auto& stream : streams) {
      if (stream.open) stream.open = stream.summary.another_pass();
      more = more || stream.open;
      summary.methods[stream.method].metrics[stream.metric] = stream.summary.summary();
    }
    if (pass == 0) {
      summary.best = best_of(cell, summary);
      summary.looks = comparisons_of_looks(cell, summary.finished);
      pairs.emplace(methods, summary.looks);
    }
    if (pass == 1 || pass == 2) pairs->another_pass();
  }
  for (std::size_t m = 0; m < methods; ++m)
    if (m != summary.best) summary.methods[m].difference = pairs->difference(m, summary.best);
  return summary;
}

}  // namespace gyrostat
