#include <gyrostat/core/running_filter.hpp>

#include <algorithm>
#include <array>

namespace gyrostat {

void run_to_the_end(RunningFilter& filter, const Series& series, Track& track) {
  track.resize(series.size());
  track.learned_first = filter.learned();
  std::array<double, 256> codes{};
  for (std::size_t first = 0; first < series.size(); first += codes.size()) {
    const std::size_t samples = std::min(codes.size(), series.size() - first);
    filter.run(columns_of(series, first),
               {.estimate_dps = track.estimate_dps.data() + first,
                .estimate_variance = track.estimate_variance.data() + first,
                .innovation_dps = track.innovation_dps.data() + first,
                .innovation_variance = track.innovation_variance.data() + first,
                .status = codes.data()},
               1, samples);
    for (std::size_t k = 0; k < samples; ++k)
      track.status[first + k] = static_cast<Status>(static_cast<int>(codes[k]));
  }
  track.learned_last = filter.learned();
}

SampleColumns columns_of(const Series& series, std::size_t first) {
  const auto from = [&](const std::vector<double>& channel) {
    return channel.empty() ? nullptr : channel.data() + first;
  };
  return {.t_s = from(series.t_s),
          .temperature_C = from(series.temperature_C),
          .mag_valid = from(series.mag_valid),
          .gyro_dps = from(series.gyro_dps),
          .heading_deg = from(series.heading_deg),
          .true_rate_dps = from(series.rate_ref_dps),
          .true_drift_dps = from(series.thermal_bias_dps)};
}

}  // namespace gyrostat
