#include "experiments/trial_pack.hpp"

#include <algorithm>
#include <chrono>
#include <new>

#include "core/filters/list.hpp"
#include "core/packed/kernels.hpp"

namespace gyrostat {
namespace {

/// A method's parameters in the order of its filter's fields.
std::vector<double> field_values(const Method& method, const ParameterMap& told) {
  std::vector<double> values;
  Filters::with(method.id, "filter", method.filter, [&](auto plugin) {
    typename decltype(plugin)::type::Parameters p;
    set_parameters(p, told);
    set_parameters(p, method.overrides);
    for (const auto& field : p.fields()) values.push_back(p.*(field.member));
  });
  return values;
}

const double* data_of(const std::vector<double>& channel) {
  return channel.empty() ? nullptr : channel.data();
}

Lane lane_of(const Series& series, Track& track) {
  track.resize(series.size());
  track.learned_first = track.learned_last = {};
  return {.gyro_dps = series.gyro_dps.data(),
          .true_rate_dps = data_of(series.rate_ref_dps),
          .true_drift_dps = data_of(series.thermal_bias_dps),
          .estimate_dps = track.estimate_dps.data(),
          .estimate_variance = track.estimate_variance.data(),
          .innovation_dps = track.innovation_dps.data(),
          .innovation_variance = track.innovation_variance.data(),
          .status = track.status.data(),
          .learned_first = &track.learned_first,
          .learned_last = &track.learned_last};
}

/// Whether the trials can share their steps.
bool are_alike(std::span<Workspace> workspaces) {
  const auto& first = workspaces.front().series;
  return std::all_of(workspaces.begin(), workspaces.end(), [&](const Workspace& w) {
    return w.series.size() == first.size() && has_truth(w.series) && !w.series.rate_ref_dps.empty();
  });
}

/// Runs the method over every trial into its own track.
void track_all(const Method& method, std::span<const ParameterMap> told,
               std::span<Workspace> workspaces) {
  const std::size_t lanes = workspaces.size();
  const auto* kernel = packed_filter(method.filter, static_cast<int>(lanes));
  if (kernel == nullptr || !are_alike(workspaces)) {
    for (std::size_t l = 0; l < lanes; ++l)
      track_method(method, told[l], workspaces[l].series, workspaces[l].track);
    return;
  }
  std::vector<double> parameters;
  std::vector<Lane> io;
  for (std::size_t l = 0; l < lanes; ++l) {
    const auto values = field_values(method, told[l]);
    parameters.resize(values.size() * lanes);
    for (std::size_t f = 0; f < values.size(); ++f) parameters[f * lanes + l] = values[f];
    io.push_back(lane_of(workspaces[l].series, workspaces[l].track));
  }
  kernel->run(parameters.data(), io.data(), workspaces.front().series.size());
}

/// All the trials at once; throws what any of them throws.
std::vector<Record> run_together(const Cell& cell, const Calibration& shared, std::uint64_t seed,
                                 std::span<const std::uint32_t> trials,
                                 std::span<Workspace> workspaces) {
  std::vector<Record> records(trials.size());
  std::vector<Calibration> calibrations(trials.size(), shared);
  std::vector<const Series*> judged(trials.size());
  for (std::size_t l = 0; l < trials.size(); ++l) {
    auto& w = workspaces[l];
    cell.make_trial(seed, trials[l], w.series);
    if (cell.calibration.each_trial && cell.needs_calibration()) {
      calibrations[l] = calibrate_cell(cell, seed, trials[l], w.calibration_series);
      records[l].calibration_converged = calibrations[l].random_error.converged;
    } else if (cell.calibration.each_trial) {
      calibrations[l] = {};
    }
    judged[l] = &cell.judged(w.series, w.denoised);
  }

  auto& clock = workspaces.front();
  clock.seconds.resize(cell.methods.size());
  clock.steps.resize(cell.methods.size());
  std::vector<ParameterMap> told(trials.size());
  for (std::size_t m = 0; m < cell.methods.size(); ++m) {
    const auto& method = cell.methods[m];
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t l = 0; l < trials.size(); ++l)
      told[l] = told_parameters(cell, method, calibrations[l], workspaces[l].series);
    track_all(method, told, workspaces);
    for (std::size_t l = 0; l < trials.size(); ++l) {
      records[l].outcomes.push_back(
          judge_track(workspaces[l].series, *judged[l], workspaces[l].track));
      clock.steps[m] += static_cast<double>(workspaces[l].series.size());
    }
    clock.seconds[m] +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return records;
}

}  // namespace

std::uint32_t default_lanes() {
  return static_cast<std::uint32_t>(available_kernels().back()->width);
}

std::vector<Record> run_trial_pack(const Cell& cell, const Calibration& shared, std::uint64_t seed,
                                   std::span<const std::uint32_t> trials,
                                   std::vector<Workspace>& workspaces) {
  if (workspaces.size() < trials.size()) workspaces.resize(trials.size());
  try {
    return run_together(cell, shared, seed, trials, {workspaces.data(), trials.size()});
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // one by one, so that each is told of its own
    std::vector<Record> records;
    for (const auto trial : trials)
      records.push_back(run_trial(cell, shared, seed, trial, workspaces.front()));
    return records;
  }
}

}  // namespace gyrostat
