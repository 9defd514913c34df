#include <gyrostat/experiments/run/packed_track.hpp>

#include <algorithm>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/core/packed/kernels.hpp>

namespace gyrostat {
namespace {

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

}  // namespace

void track_together(const Method& method, std::span<const ParameterMap> told,
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
    const auto values = field_values(method.type(), told[l], method.overrides);
    parameters.resize(values.size() * lanes);
    for (std::size_t f = 0; f < values.size(); ++f) parameters[f * lanes + l] = values[f];
    io.push_back(lane_of(workspaces[l].series, workspaces[l].track));
  }
  kernel->run(parameters.data(), io.data(), workspaces.front().series.size());
}

}  // namespace gyrostat
