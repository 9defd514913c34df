#include <gyrostat/experiments/run/trial.hpp>

#include <gyrostat/analysis/spectra/shrinkage.hpp>
#include <gyrostat/experiments/run/outcome_numbers.hpp>
#include <gyrostat/experiments/study/fleet.hpp>
#include <gyrostat/generators/true_parameters.hpp>

namespace gyrostat {

const Scenario& sensor_of(const Cell& cell, const Noise& trial, Scenario& drawn) {
  if (!cell.fleet) return cell.scenario;
  cell.fleet->draw(cell.scenario, trial, drawn);
  return drawn;
}

void make_trial(const Cell& cell, std::uint64_t seed, std::uint32_t trial, Series& series) {
  make_trial(cell, {seed, trial}, series);
}

void make_trial(const Cell& cell, const Noise& noise, Series& series) {
  Scenario drawn;
  if (!cell.recording) return synthesise(sensor_of(cell, noise, drawn), noise, series);
  const std::size_t samples = cell.scenario.sampling.samples();
  series = cell.recording->slice(noise.trial * samples, samples);
}

const Series& judged_series(const Cell& cell, const Series& series, Series& buffer) {
  if (!cell.denoise) return series;
  buffer = series;
  const bool moves = !series.rate_ref_dps.empty();
  for (std::size_t i = 0; moves && i < series.size(); ++i)
    buffer.gyro_dps[i] -= series.rate_ref_dps[i];
  buffer.gyro_dps = shrink_rate(buffer.gyro_dps).rate;
  for (std::size_t i = 0; moves && i < series.size(); ++i)
    buffer.gyro_dps[i] += series.rate_ref_dps[i];
  return buffer;
}

void track_method(const Method& method, const ParameterMap& told, const Series& series,
                  Track& track) {
  run_filter(method.type(), told, method.overrides, series, track);
}

std::vector<double> judge_track(const Series& series, const Series& judged, const Track& track) {
  return numbers_of(track_errors(judged, track), uncompensated_rmse(series), {&judged, &track});
}

Noise calibration_noise(std::uint64_t seed, std::uint32_t trial) { return {~seed, trial}; }

Noise calibration_noise(const Noise& trial) {
  return {~trial.seed, trial.trial, trial.shares, trial.tape, trial.shift, "calibration/"};
}

ParameterMap told_parameters(const Cell& cell, const Scenario& sensor, const Method& method,
                             const Calibration& calibration, const Series& series) {
  ParameterMap parameters;
  if (method.source == ParameterSource::truth) parameters = true_parameters(sensor);
  if (method.source == ParameterSource::calibration)
    parameters = parameters_from(
        calibration, series.temperature_C.empty() ? no_value : series.temperature_C.front());
  if (method.role().is_bound()) return parameters;
  for (const auto& [name, factor] : cell.assumed)
    if (const auto value = parameters.find(name); value != parameters.end())
      value->second *= factor;
  return parameters;
}

Calibration calibrate_cell(const Cell& cell, std::uint64_t seed, std::uint32_t trial,
                           Series& buffer) {
  return calibrate_cell(cell, {seed, trial}, buffer);
}

Calibration calibrate_cell(const Cell& cell, const Noise& trial, Series& buffer) {
  if (cell.recording) return calibrate(cell.calibration_span, cell.calibration.method);
  Scenario scenario = cell.scenario;
  if (cell.calibration.each_trial) scenario = sensor_of(cell, trial, scenario);
  if (cell.calibration.duration_s > 0.0) scenario.sampling.duration_s = cell.calibration.duration_s;
  synthesise(scenario, calibration_noise(trial), buffer);
  return calibrate(buffer, cell.calibration.method);
}

void track_trial(const Cell& cell, const Method& method, const Calibration& shared,
                 const Noise& trial, Workspace& workspace) {
  make_trial(cell, trial, workspace.series);
  const bool own = cell.calibration.each_trial && cell.needs_calibration();
  const auto calibration = own ? calibrate_cell(cell, trial, workspace.calibration_series) : shared;
  Scenario drawn;
  const auto& sensor = sensor_of(cell, trial, drawn);
  track_method(method, told_parameters(cell, sensor, method, calibration, workspace.series),
               workspace.series, workspace.track);
}

}  // namespace gyrostat
