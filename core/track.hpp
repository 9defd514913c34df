#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gyrostat/core/series.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat {

/// What a filter made of a series: one entry a sample in each column.
struct Track {
  std::vector<double> estimate_dps;
  std::vector<double> estimate_variance;
  std::vector<double> innovation_dps;
  std::vector<double> innovation_variance;
  std::vector<Status> status;
  LearnedParameters learned_first;  ///< before the first sample; NaN for filters that learn none
  LearnedParameters learned_last;   ///< after the last

  void resize(std::size_t samples);
  /// Steps of each Status, in the order of the enumeration.
  std::array<std::uint32_t, status_names.size()> status_counts() const;
};

/// Sample `i` as a filter may see it: no heading where the compass is flagged as disturbed.
Sample<double> sample_at(const Series& series, std::size_t i);

/// The channels that `needs` asks for and `series` lacks, by name; empty when it can be run.
std::vector<std::string> missing_channels(const Needs& needs, const Series& series);

template <Filter F>
LearnedParameters learned_by(const F& filter) {
  if constexpr (requires { filter.learned(); })
    return filter.learned();
  else
    return {};
}

/// Runs `filter` over every sample of `series` into `track`, whose memory is reused.
///
/// Example: a filter by its type, and the rate that it leaves.
///
///   #include <gyrostat/core/filters/kf.hpp>
///
///   Series series;
///   synthesise(Scenario{}, {.seed = 1, .trial = 0}, series);
///   Track track;
///   run_filter(filters::Kf<double>({Arima111<double>{.phi = 0.3}, {}}), series, track);
///   const double compensated_dps = series.gyro_dps[10] - track.estimate_dps[10];
///
/// Thread safety: may run in any number of threads at once, each with a `track` of its own.
template <Filter F>
void run_filter(F filter, const Series& series, Track& track) {
  track.resize(series.size());
  track.learned_first = learned_by(filter);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const auto step = filter.step(sample_at(series, i));
    track.estimate_dps[i] = step.estimate_dps;
    track.estimate_variance[i] = step.estimate_variance;
    track.innovation_dps[i] = step.innovation_dps;
    track.innovation_variance[i] = step.innovation_variance;
    track.status[i] = step.status;
  }
  track.learned_last = learned_by(filter);
}

}  // namespace gyrostat
