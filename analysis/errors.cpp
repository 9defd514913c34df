#include <gyrostat/analysis/errors.hpp>

#include <algorithm>

#include <gyrostat/analysis/judge/judge.hpp>

namespace gyrostat {
namespace {

const double* from(const std::vector<double>& channel, std::size_t first) {
  return channel.empty() ? nullptr : channel.data() + first;
}

}  // namespace

TrackErrors track_errors(const Series& series, const Track& track) {
  judge::Judge<double> judge;
  std::array<double, JudgedSteps::most> codes{};
  const bool truth = has_truth(series);
  for (std::size_t first = 0; first < series.size(); first += codes.size()) {
    const std::size_t samples = std::min(codes.size(), series.size() - first);
    for (std::size_t k = 0; k < samples; ++k)
      codes[k] = static_cast<double>(track.status[first + k]);
    judge.add({.samples = samples,
               .t_s = from(series.t_s, first),
               .gyro_dps = from(series.gyro_dps, first),
               .true_rate_dps = from(series.rate_ref_dps, first),
               .true_drift_dps = truth ? from(series.thermal_bias_dps, first) : nullptr,
               .random_error_dps = truth ? from(series.random_error_dps, first) : nullptr,
               .estimate_dps = from(track.estimate_dps, first),
               .estimate_variance = from(track.estimate_variance, first),
               .innovation_dps = from(track.innovation_dps, first),
               .innovation_variance = from(track.innovation_variance, first),
               .status = codes.data()});
  }
  TrackErrors errors;
  judge.finish(0, errors);
  errors.learned_first = track.learned_first;
  errors.learned_last = track.learned_last;
  return errors;
}

Innovations innovation_statistics(const Track& track) {
  judge::Whiteness<double> whiteness;
  for (std::size_t first = 0; first < track.status.size(); first += JudgedSteps::most)
    whiteness.add(from(track.innovation_dps, first), from(track.innovation_variance, first),
                  std::min(JudgedSteps::most, track.status.size() - first));
  return whiteness.of_lane(0);
}

}  // namespace gyrostat
