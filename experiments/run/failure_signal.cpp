#include <gyrostat/experiments/run/failure_signal.hpp>

#include <algorithm>
#include <cmath>

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

std::vector<NoiseShare> scaled(const Weights& weights, double by) {
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
  NoiseTape of_calibration;
  auto calibration = calibration_noise(noise);
  calibration.tape = &of_calibration;
  auto scenario = sensor;
  if (cell.calibration.duration_s > 0.0) scenario.sampling.duration_s = cell.calibration.duration_s;
  synthesise(scenario, calibration, series);
  for (auto& [name, deviates] : of_calibration) tape["calibration/" + name] = std::move(deviates);
  return tape;
}

/// The squared length of what vectors that come one by one have in common: their mean product.
struct Common {
  std::vector<double> sum;
  double squares = 0.0;

  void add(const std::vector<double>& values) {
    if (sum.size() < values.size()) sum.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum[i] += values[i];
      squares += values[i] * values[i];
    }
  }
  double squared_length(double count) const {
    double all = 0.0;
    for (const double s : sum) all += s * s;
    return (all - squares) / (count * (count - 1.0));
  }
};

}  // namespace

std::optional<FailureSignal> failure_signal(const PreparedCell& prepared, const FailureRule& rule,
                                            const FailureSearch& search, const Store& store,
                                            std::uint32_t index, std::uint64_t seed) {
  const auto side = sides(rule, store, index, search.numbers());
  double left = 0.0, right = 0.0;
  for (const auto& run : search.runs())
    for (const auto trial : run.failing()) (side[trial] < 0 ? left : right) += 1.0;
  const int wanted = left > right ? -1 : 1;

  double runs = 0.0;
  Weights mean;
  std::map<std::string, Common> streams;
  for (const auto& run : search.runs()) {
    const auto of_run = mean_of(run, side, wanted);
    if (of_run.empty()) continue;
    ++runs;
    for (const auto& [trial, weight] : of_run) mean[trial] += weight;
    const auto shares = scaled(of_run, 1.0);
    for (const auto& [name, deviates] : drawn(prepared, {seed, 0, shares}))
      streams[name].add(deviates);
  }
  if (runs < 2.0) return std::nullopt;
  for (auto& [trial, weight] : mean) weight /= runs;

  FailureSignal signal;
  double squared = 0.0;
  for (const auto& [name, common] : streams) {
    const double part = std::max(0.0, common.squared_length(runs));
    signal.drivers[name] = part;
    squared += part;
  }
  if (!(squared > 0.0)) return std::nullopt;
  for (auto& [name, part] : signal.drivers) part /= squared;

  std::vector<Workspace> workspaces(1);
  const auto metric_at = [&](double scale) {
    const auto shares = scaled(mean, scale);
    return run_trial(prepared.cell, prepared.calibration, Noise{seed, 0, shares}, workspaces)
        .of(0)
        .metric(rule.metric);
  };
  const auto excess = [&](double metric) {
    return std::clamp(rule.badness(metric) - rule.worst_allowed(), -1e300, 1e300);
  };
  // The mean of failing trials lies a little beyond the design point.
  double low = 0.0, high = 1.0, metric = metric_at(high);
  for (; excess(metric) <= 0.0 && high < 4.0; metric = metric_at(high)) low = high, high *= 1.25;
  if (excess(metric) <= 0.0) return std::nullopt;
  for (int step = 0; step < 12; ++step) {
    const double middle = 0.5 * (low + high), there = metric_at(middle);
    if (excess(there) > 0.0)
      high = middle, metric = there;
    else
      low = middle;
  }
  signal.shares = scaled(mean, high);
  signal.metric = metric;
  signal.distance = high * std::sqrt(squared);
  signal.same_side = std::max(left, right) / (left + right);
  return signal;
}

}  // namespace gyrostat
