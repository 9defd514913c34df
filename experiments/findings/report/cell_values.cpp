#include <gyrostat/experiments/findings/report/cell_values.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/experiments/run/trial.hpp>

namespace gyrostat {

TrialSource trials_of(const Cell& cell, const Store& store, std::uint32_t index) {
  return [&cell, &store, index](const auto& visit) {
    store.for_each_trial(index, cell.trials, [&](const Store::TrialView& trial) {
      visit(trial.calibrated, trial.outcomes);
    });
  };
}

CellValues cell_values(const Cell& cell, const Store& store, std::uint32_t index) {
  CellValues all;
  all.metric = std::string(judging_metric(cell));
  const std::size_t metric = metric_named(all.metric, "report");
  all.title = metric_types()[metric].title;
  all.unit = std::string(metric_types()[metric].unit);
  all.values.resize(cell.methods.size());
  store.for_each_trial(index, cell.trials, [&](const Store::TrialView& trial) {
    all.trials.push_back(trial.trial);
    const TrialOutcomes outcomes(trial.outcomes, all.values.size());
    for (std::size_t m = 0; m < all.values.size(); ++m)
      all.values[m].push_back(outcomes[m].metric(metric));
  });
  return all;
}

std::vector<std::size_t> best_first(const Cell& cell, const CellSummary& summary) {
  std::vector<std::size_t> order(cell.methods.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::size_t m) {
    const double mean = summary.of(m, judging_metric(cell)).mean;
    return std::pair(cell.methods[m].role().is_bound() ? 2
                     : std::isnan(mean)                ? 1
                                                       : 0,
                     std::isnan(mean) ? 0.0 : mean);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

std::vector<std::size_t> worst_trials(const std::vector<double>& values, std::size_t count) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i])) places.push_back(i);
  const auto end = places.begin() + static_cast<std::ptrdiff_t>(std::min(count, places.size()));
  std::partial_sort(places.begin(), end, places.end(), [&](std::size_t a, std::size_t b) {
    return values[a] != values[b] ? values[a] > values[b] : a < b;
  });
  places.erase(end, places.end());
  return places;
}

}  // namespace gyrostat
