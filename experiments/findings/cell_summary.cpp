#include <gyrostat/experiments/findings/cell_summary.hpp>

#include <algorithm>
#include <limits>
#include <optional>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/statistics/all_pairs.hpp>
#include <gyrostat/analysis/statistics/streamed.hpp>
#include <gyrostat/core/outcome.hpp>
#include <gyrostat/experiments/run/stopping.hpp>

namespace gyrostat {
namespace {

void count_failures(const Outcome& outcome, MethodSummary& summary) {
  summary.thrown += outcome.threw();
  summary.breakdown_steps += static_cast<std::size_t>(outcome.breakdown_steps());
  summary.broken_down += outcome.broke_down();
  summary.diverged += outcome.diverged();
}

std::size_t best_of(const Cell& cell, const CellSummary& summary) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    const double mean = summary.of(m, judging_metric(cell)).mean;
    if (cell.methods[m].role().is_bound() || !(mean < least)) continue;
    least = mean;
    best = m;
  }
  return best;
}

/// Indices of the metrics that tell of consistency.
std::vector<std::size_t> consistency_metrics() {
  std::vector<std::size_t> indices;
  for (std::size_t m = 0; m < metric_types().size(); ++m)
    if (metric_types()[m].goal == Goal::consistent) indices.push_back(m);
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
  return methods[method].metrics[metric_named(metric, "tables")];
}

const Running& CellSummary::running(std::size_t method, std::string_view metric) const {
  return methods[method].running[metric_named(metric, "tables")];
}

std::vector<std::string_view> error_metrics(const Cell& cell) {
  std::vector<const MetricType*> tabled;
  for (const auto& metric : metric_types())
    if (metric.table.place > 1 || metric.id == judging_metric(cell)) tabled.push_back(&metric);
  std::stable_sort(tabled.begin(), tabled.end(),
                   [](const auto* a, const auto* b) { return a->table.place < b->table.place; });
  std::vector<std::string_view> ids;
  for (const auto* metric : tabled) ids.push_back(metric->id);
  return ids;
}

CellSummary summarise_cell(const Cell& cell, const TrialSource& trials) {
  const std::size_t methods = cell.methods.size();
  CellSummary summary;
  summary.methods.resize(methods);
  for (auto& method : summary.methods) {
    method.metrics.resize(metric_types().size());
    method.running.resize(metric_types().size());
  }
  const auto consistency = consistency_metrics();

  auto shown = error_metrics(cell);
  shown.insert(shown.end(), {"nis", "nees"});
  std::vector<Streamed> streams;
  for (std::size_t m = 0; m < methods; ++m)
    for (const auto metric : shown) streams.push_back({m, metric_named(metric, "tables"), {}});

  const std::size_t judging = metric_named(judging_metric(cell), "tables");
  std::optional<AllPairs> pairs;
  std::vector<double> judged(methods);
  bool more = true;
  for (int pass = 0; more || pass < 3; ++pass) {
    trials([&](bool calibrated, std::span<const double> numbers) {
      const TrialOutcomes outcomes(numbers, methods);
      if (pass == 0) {
        ++summary.finished;
        summary.unconverged += !calibrated;
        for (std::size_t m = 0; m < methods; ++m) {
          count_failures(outcomes[m], summary.methods[m]);
          for (const auto metric : consistency)
            summary.methods[m].running[metric].add(outcomes[m].metric(metric));
        }
      }
      for (auto& stream : streams)
        if (stream.open) stream.summary.add(outcomes[stream.method].metric(stream.metric));
      if (pass != 1 && pass != 2) return;
      for (std::size_t m = 0; m < methods; ++m) judged[m] = outcomes[m].metric(judging);
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
