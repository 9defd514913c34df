#include "experiments/trial.hpp"

#include <chrono>
#include <new>

#include "analysis/errors.hpp"
#include "core/filters/list.hpp"

namespace gyrostat {
namespace {

/// RMS of what there is to compensate: drift and random error. NaN without the truth.
double uncompensated_rmse(const Series& series) {
  if (!has_truth(series)) return no_value;
  return error_moments(
             series.size(),
             [&](std::size_t i) { return series.thermal_bias_dps[i] + series.random_error_dps[i]; })
      .rmse;
}

}  // namespace

std::uint32_t Outcome::breakdowns() const {
  std::uint32_t sum = 0;
  for (std::size_t s = 0; s < status_counts.size(); ++s)
    if (is_breakdown(static_cast<Status>(s))) sum += status_counts[s];
  return sum;
}

void track_method(const Method& method, const ParameterMap& parameters, const Series& series,
                  Track& track) {
  Filters::with(method.id, "filter", method.filter, [&](auto plugin) {
    using F = typename decltype(plugin)::type;
    typename F::Parameters p;
    set_parameters(p, parameters);
    set_parameters(p, method.overrides);
    run_filter(F(p), series, track);
  });
}

Outcome run_method(const Method& method, const ParameterMap& parameters, const Series& series,
                   const Series& judged, Track& track) {
  track_method(method, parameters, series, track);
  return judge_track(series, judged, track);
}

Outcome judge_track(const Series& series, const Series& judged, const Track& track) {
  Outcome outcome;
  const TrackErrors errors = track_errors(judged, track);
  std::size_t m = 0;
  Metrics::for_each(
      [&](auto plugin) { outcome.metrics[m++] = typename decltype(plugin)::type{}(errors); });
  outcome.status_counts = track.status_counts();
  outcome.diverged = errors.bias.rmse > divergence_ratio * uncompensated_rmse(series);
  return outcome;
}

Noise calibration_noise(std::uint64_t seed, std::uint32_t trial) { return {~seed, trial}; }

ParameterMap told_parameters(const Cell& cell, const Method& method, const Calibration& calibration,
                             const Series& series) {
  ParameterMap parameters;
  if (method.source == ParameterSource::truth) parameters = true_parameters(cell.scenario);
  if (method.source == ParameterSource::calibration)
    parameters = parameters_from(
        calibration, series.temperature_C.empty() ? no_value : series.temperature_C.front());
  if (method.filter == "oracle") return parameters;
  for (const auto& [name, factor] : cell.assumed)
    if (const auto value = parameters.find(name); value != parameters.end())
      value->second *= factor;
  return parameters;
}

Calibration calibrate_cell(const Cell& cell, std::uint64_t seed, std::uint32_t trial,
                           Series& buffer) {
  if (cell.recording) return calibrate(cell.calibration_span, cell.calibration.method);
  Scenario scenario = cell.scenario;
  if (cell.calibration.duration_s > 0.0) scenario.sampling.duration_s = cell.calibration.duration_s;
  synthesise(scenario, calibration_noise(seed, trial), buffer);
  return calibrate(buffer, cell.calibration.method);
}

namespace {

/// `work`'s outcome, or what it threw.
template <class Work>
Outcome quarantined(const Work& work) {
  std::string thrown;
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    thrown = failure.what();
  }
  Outcome outcome;
  outcome.metrics.fill(no_value);
  outcome.thrown = thrown.empty() ? "unknown" : thrown;
  return outcome;
}

}  // namespace

Record run_trial(const Cell& cell, const Calibration& shared, std::uint64_t seed,
                 std::uint32_t trial, Workspace& workspace) {
  Record record;
  auto& series = workspace.series;
  Calibration own;
  const Series* judged = nullptr;
  const auto prepared = quarantined([&] {
    cell.make_trial(seed, trial, series);
    if (cell.calibration.each_trial && cell.needs_calibration()) {
      own = calibrate_cell(cell, seed, trial, workspace.calibration_series);
      record.calibration_converged = own.random_error.converged;
    }
    judged = &cell.judged(series, workspace.denoised);
    return Outcome{};
  });
  if (!prepared.thrown.empty()) {
    record.outcomes.assign(cell.methods.size(), prepared);
    return record;
  }
  const Calibration& calibration = cell.calibration.each_trial ? own : shared;

  workspace.seconds.resize(cell.methods.size());
  workspace.steps.resize(cell.methods.size());
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    const auto& method = cell.methods[m];
    const auto start = std::chrono::steady_clock::now();
    record.outcomes.push_back(quarantined([&] {
      return run_method(method, told_parameters(cell, method, calibration, series), series, *judged,
                        workspace.track);
    }));
    workspace.seconds[m] +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    workspace.steps[m] += static_cast<double>(series.size());
  }
  return record;
}

}  // namespace gyrostat
