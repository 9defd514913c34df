#include <gyrostat/experiments/run/tuning.hpp>

#include <algorithm>

#include <tbb/parallel_for.h>

#include <gyrostat/analysis/search/box_search.hpp>
#include <gyrostat/experiments/run/trial.hpp>

namespace gyrostat {
namespace {

struct Signal {
  Scenario sensor;
  Series series, denoised;
};

/// Where tuning signals begin under the calibration's seed, whatever the number of trials: above
/// trial 0 where that is the only calibration, above every trial where each has its own.
std::uint32_t first_tuning_trial(const Cell& cell) {
  return cell.calibration.each_trial ? 4'000'000'000U : 1000U;
}

/// Signals under the calibration's seed, beyond the trials that calibrations use.
std::vector<Signal> tuning_signals(const Cell& cell, std::uint64_t seed) {
  std::vector<Signal> signals(cell.tuning.trials);
  tbb::parallel_for(std::size_t{0}, signals.size(), [&](std::size_t i) {
    const auto noise =
        calibration_noise(seed, first_tuning_trial(cell) + static_cast<std::uint32_t>(i));
    signals[i].sensor = sensor_of(cell, noise, signals[i].sensor);
    if (cell.tuning.undisturbed) signals[i].sensor.compass.disturbances.clear();
    synthesise(signals[i].sensor, noise, signals[i].series);
    (void)judged_series(cell, signals[i].series, signals[i].denoised);
  });
  return signals;
}

TuningScore score(const Cell& cell, const Method& method, const Calibration& calibration,
                  const std::vector<Signal>& signals) {
  std::vector<std::vector<double>> outcomes(signals.size());
  tbb::parallel_for(std::size_t{0}, signals.size(), [&](std::size_t i) {
    thread_local Track track;
    const auto& [sensor, series, denoised] = signals[i];
    const auto parameters = told_parameters(cell, sensor, method, calibration, series);
    track_method(method, parameters, series, track);
    outcomes[i] = judge_track(series, cell.denoise ? denoised : series, track);
  });
  TuningScore score{.mean = 0.0};
  for (const auto& numbers : outcomes) {
    const Outcome outcome(numbers);
    score.mean += outcome.metric(cell.tuning.metric);
    score.broken_down += outcome.broke_down();
  }
  score.mean /= static_cast<double>(outcomes.size());
  return score;
}

}  // namespace

std::vector<TunedMethod> tune_methods(const Cell& cell, const Calibration& calibration,
                                      std::uint64_t seed) {
  std::vector<TunedMethod> tuned(cell.methods.size());
  const auto is_tuned = [](const Method& m) { return !m.tune.empty(); };
  if (std::none_of(cell.methods.begin(), cell.methods.end(), is_tuned)) return tuned;

  const auto signals = tuning_signals(cell, seed);
  for (std::size_t m = 0; m < tuned.size(); ++m) {
    Method method = cell.methods[m];
    if (!is_tuned(method)) continue;
    tuned[m].before = score(cell, method, calibration, signals);
    std::vector<SearchRange> ranges;
    for (const auto& [name, range] : method.tune) ranges.push_back(range);
    const auto set = [&](const std::vector<double>& values) {
      std::size_t i = 0;
      for (const auto& [name, range] : method.tune) method.overrides[name] = values[i++];
    };
    const auto found = box_search(ranges, cell.tuning.evaluations, [&](const auto& values) {
      set(values);
      return score(cell, method, calibration, signals).mean;
    });
    set(found.values);
    for (const auto& [name, range] : method.tune) tuned[m].values[name] = method.overrides[name];
    tuned[m].after = score(cell, method, calibration, signals);
  }
  return tuned;
}

Cell with_tuned(const Cell& cell, const std::vector<TunedMethod>& tuned) {
  Cell fixed = cell;
  for (std::size_t m = 0; m < tuned.size(); ++m)
    for (const auto& [name, value] : tuned[m].values) fixed.methods[m].overrides[name] = value;
  return fixed;
}

}  // namespace gyrostat
