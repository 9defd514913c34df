#include <gyrostat/experiments/run/trial.hpp>

#include <chrono>
#include <new>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/spectra/shrinkage.hpp>
#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/experiments/run/packed_track.hpp>
#include <gyrostat/generators/true_parameters.hpp>

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

void make_trial(const Cell& cell, std::uint64_t seed, std::uint32_t trial, Series& series) {
  make_trial(cell, {seed, trial}, series);
}

void make_trial(const Cell& cell, const Noise& noise, Series& series) {
  if (!cell.recording) return synthesise(cell.scenario, noise, series);
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
  std::vector<double> numbers;
  const TrackErrors errors = track_errors(judged, track);
  for (const auto& metric : metric_types()) {
    const double value = metric(errors);
    numbers.push_back(std::isnan(value) ? no_value : value);
  }
  for (const auto count : track.status_counts()) numbers.push_back(count);
  numbers.push_back(errors.bias.rmse > divergence_ratio * uncompensated_rmse(series));
  return numbers;
}

Noise calibration_noise(std::uint64_t seed, std::uint32_t trial) { return {~seed, trial}; }

Noise calibration_noise(const Noise& trial) { return {~trial.seed, trial.trial, trial.shares}; }

ParameterMap told_parameters(const Cell& cell, const Method& method, const Calibration& calibration,
                             const Series& series) {
  ParameterMap parameters;
  if (method.source == ParameterSource::truth) parameters = true_parameters(cell.scenario);
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
  if (cell.calibration.duration_s > 0.0) scenario.sampling.duration_s = cell.calibration.duration_s;
  synthesise(scenario, calibration_noise(trial), buffer);
  return calibrate(buffer, cell.calibration.method);
}

std::uint32_t default_lanes() {
  return static_cast<std::uint32_t>(available_kernels().back()->width);
}

namespace {

/// What `work` threw; empty where it did not.
template <class Work>
std::string thrown_by(const Work& work) {
  try {
    work();
    return {};
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& failure) {
    const std::string what = failure.what();
    return what.empty() ? "unknown" : what;
  }
}

void append(Record& record, const std::vector<double>& numbers, const std::string& thrown) {
  record.numbers.insert(record.numbers.end(), numbers.begin(), numbers.end());
  record.thrown.push_back(thrown);
}

/// The outcome of a method that threw.
void append_thrown(Record& record, const std::string& thrown) {
  std::vector<double> nothing(metric_types().size() + Outcome::beside_metrics, 0.0);
  std::fill_n(nothing.begin(), metric_types().size(), no_value);
  append(record, nothing, thrown);
}

class TrialsTogether {
 public:
  TrialsTogether(const Cell& cell, const Calibration& shared, std::span<const Noise> trials,
                 std::span<Workspace> lanes)
      : cell_(cell),
        shared_(shared),
        trials_(trials),
        lanes_(lanes),
        own_(trials.size()),
        judged_(trials.size()),
        records_(trials.size()) {
    lanes.front().seconds.resize(cell.methods.size());
    lanes.front().steps.resize(cell.methods.size());
  }

  void prepare() {
    for (std::size_t l = 0; l < trials_.size(); ++l) {
      auto& w = lanes_[l];
      make_trial(cell_, trials_[l], w.series);
      if (cell_.calibration.each_trial && cell_.needs_calibration()) {
        own_[l] = calibrate_cell(cell_, trials_[l], w.calibration_series);
        records_[l].calibration_converged = own_[l].random_error.converged;
      }
      judged_[l] = &judged_series(cell_, w.series, w.denoised);
    }
  }

  void run(std::size_t m) {
    const auto& method = cell_.methods[m];
    auto& clock = lanes_.front();
    const auto start = std::chrono::steady_clock::now();
    std::vector<ParameterMap> told;
    for (std::size_t l = 0; l < trials_.size(); ++l)
      told.push_back(told_parameters(
          cell_, method, cell_.calibration.each_trial ? own_[l] : shared_, lanes_[l].series));
    track_together(method, told, lanes_);
    for (std::size_t l = 0; l < trials_.size(); ++l) {
      append(records_[l], judge_track(lanes_[l].series, *judged_[l], lanes_[l].track), "");
      clock.steps[m] += static_cast<double>(lanes_[l].series.size());
    }
    clock.seconds[m] +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  std::vector<Record> records_of_all() { return std::move(records_); }
  Record& only() { return records_.front(); }

 private:
  const Cell& cell_;
  const Calibration& shared_;
  std::span<const Noise> trials_;
  std::span<Workspace> lanes_;
  std::vector<Calibration> own_;
  std::vector<const Series*> judged_;
  std::vector<Record> records_;
};

}  // namespace

std::vector<Record> run_trials_together(const Cell& cell, const Calibration& shared,
                                        std::uint64_t seed, std::span<const std::uint32_t> trials,
                                        std::vector<Workspace>& workspaces) {
  std::vector<Noise> noises;
  for (const auto trial : trials) noises.push_back({seed, trial});
  return run_trials_together(cell, shared, noises, workspaces);
}

std::vector<Record> run_trials_together(const Cell& cell, const Calibration& shared,
                                        std::span<const Noise> trials,
                                        std::vector<Workspace>& workspaces) {
  if (workspaces.size() < trials.size()) workspaces.resize(trials.size());
  TrialsTogether together(cell, shared, trials, {workspaces.data(), trials.size()});
  const bool alone = trials.size() == 1;
  auto thrown = thrown_by([&] { together.prepare(); });
  const bool prepared = thrown.empty();
  for (std::size_t m = 0; m < cell.methods.size() && (alone || thrown.empty()); ++m) {
    if (prepared) thrown = thrown_by([&] { together.run(m); });
    if (alone && !thrown.empty()) append_thrown(together.only(), thrown);
  }
  if (alone || thrown.empty()) return together.records_of_all();
  std::vector<Record> records;  // one by one, so that each is told of its own
  for (const auto& trial : trials) records.push_back(run_trial(cell, shared, trial, workspaces));
  return records;
}

Record run_trial(const Cell& cell, const Calibration& shared, const Noise& trial,
                 std::vector<Workspace>& workspaces) {
  return std::move(run_trials_together(cell, shared, {&trial, 1}, workspaces).front());
}

Record run_trial(const Cell& cell, const Calibration& shared, std::uint64_t seed,
                 std::uint32_t trial, std::vector<Workspace>& workspaces) {
  return run_trial(cell, shared, Noise{seed, trial}, workspaces);
}

}  // namespace gyrostat
