#include <gyrostat/experiments/run/failing_means.hpp>

#include <algorithm>

#include <gyrostat/analysis/metric_type.hpp>

namespace gyrostat {
namespace {

/// To which side each trial of a search errs, by number: -1, 1, or 0 for one that is not there.
std::vector<int> sides(const FailureRule& rule, const Store& store, std::uint32_t index,
                       std::uint32_t numbers) {
  const auto& metric = metric_types()[rule.metric].id;
  const auto named = [](const char* name) { return metric_named(name, name); };
  const auto signed_error = [&](const Outcome& outcome) {
    if (metric.starts_with("heading"))
      return outcome.metric(named("heading_max")) + outcome.metric(named("heading_min"));
    return outcome.metric(named(metric.starts_with("rate") ? "rate_mean" : "bias_mean"));
  };
  std::vector<int> side(numbers, 0);
  store.for_each_trial(index, numbers, [&](const Store::TrialView& trial) {
    side[trial.trial] = signed_error(Outcome(trial.outcomes)) < 0.0 ? -1 : 1;
  });
  return side;
}

using Weights = std::map<std::uint32_t, double>;  ///< by trial

/// Mean of the deviates of those failing trials of a run that err to `wanted`.
Weights mean_of(const SubsetSimulation& run, const std::vector<int>& side, int wanted) {
  Weights mean;
  double count = 0.0;
  for (const auto trial : run.failing()) {
    if (side[trial] != wanted) continue;
    ++count;
    for (const auto& share : run.shares(run.move(trial))) mean[share.trial] += share.weight;
  }
  for (auto& [trial, weight] : mean) weight /= count;
  return mean;
}

std::vector<NoiseShare> shares_of(const Weights& weights, double by) {
  std::vector<NoiseShare> shares;
  for (const auto& [trial, weight] : weights) shares.push_back({trial, by * weight});
  return shares;
}

/// All deviates of a trial's signal, and of its own calibration where it has one.
NoiseTape drawn(const PreparedCell& prepared, const Noise& noise) {
  const auto& cell = prepared.cell;
  NoiseTape tape;
  Series series;
  auto heard = noise;
  heard.tape = &tape;
  Scenario drawn_sensor;
  const auto& sensor = sensor_of(cell, heard, drawn_sensor);
  synthesise(sensor, heard, series);
  if (!cell.calibration.each_trial || !cell.needs_calibration()) return tape;
  auto scenario = sensor;
  if (cell.calibration.duration_s > 0.0) scenario.sampling.duration_s = cell.calibration.duration_s;
  synthesise(scenario, calibration_noise(heard), series);
  return tape;
}

}  // namespace

std::optional<FailingMeans> failing_means(const PreparedCell& prepared, const FailureRule& rule,
                                          const FailureSearch& search, const Store& store,
                                          std::uint32_t index, std::uint64_t seed) {
  const auto side = sides(rule, store, index, search.numbers());
  double left = 0.0, right = 0.0;
  for (const auto& run : search.runs())
    for (const auto trial : run.failing()) (side[trial] < 0 ? left : right) += 1.0;
  FailingMeans means;
  Weights mean;
  for (const auto& run : search.runs()) {
    const auto of_run = mean_of(run, side, left > right ? -1 : 1);
    if (of_run.empty()) continue;
    for (const auto& [trial, weight] : of_run) mean[trial] += weight;
    const auto shares = shares_of(of_run, 1.0);
    means.of_runs.push_back(drawn(prepared, {seed, 0, shares}));
  }
  if (means.of_runs.size() < 2) return std::nullopt;
  means.shares = shares_of(mean, 1.0 / static_cast<double>(means.of_runs.size()));
  means.same_side = std::max(left, right) / (left + right);
  return means;
}

}  // namespace gyrostat
