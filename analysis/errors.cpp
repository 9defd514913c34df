#include "analysis/errors.hpp"

#include <algorithm>
#include <vector>

namespace gyrostat {

HeadingExcursion heading_excursion(const Series& series, const Track& track) {
  HeadingExcursion heading;
  for (std::size_t i = 1; i < series.size(); ++i) {
    const double e = rate_error_dps(series, track, i);
    if (!std::isnan(e)) heading.end_deg += e * (series.t_s[i] - series.t_s[i - 1]);
    heading.min_deg = std::min(heading.min_deg, heading.end_deg);
    heading.max_deg = std::max(heading.max_deg, heading.end_deg);
  }
  return heading;
}

StatedCovariance covariance_statistics(const Series& series, const Track& track) {
  StatedCovariance stated;
  double sum = 0.0;
  std::size_t count = 0, within_1 = 0, within_3 = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double error = bias_error_dps(series, track, i);
    const double squared = error * error / track.estimate_variance[i];
    if (std::isnan(squared)) continue;
    ++count;
    sum += squared;
    within_1 += squared <= 1.0;
    within_3 += squared <= 9.0;
    stated.nees_end = squared;
  }
  if (count == 0) return stated;
  const double n = static_cast<double>(count);
  stated.nees = sum / n;
  stated.within_1_sigma = static_cast<double>(within_1) / n;
  stated.within_3_sigma = static_cast<double>(within_3) / n;
  return stated;
}

TrackErrors track_errors(const Series& series, const Track& track) {
  std::vector<double> values(series.size());  // each error is computed once and read twice
  const auto over_time = [&](const auto& error) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = error(i);
    return error_moments(values.size(), [&](std::size_t i) { return values[i]; });
  };
  TrackErrors errors;
  errors.rate = over_time([&](std::size_t i) { return rate_error_dps(series, track, i); });
  errors.innovations = innovation_statistics(track);
  errors.heading = heading_excursion(series, track);
  const auto broken = std::find_if(track.status.begin(), track.status.end(), is_breakdown);
  if (broken != track.status.end())
    errors.first_breakdown_s = series.t_s[broken - track.status.begin()] - series.t_s.front();
  errors.learned_first = track.learned_first;
  errors.learned_last = track.learned_last;
  if (!has_truth(series)) return errors;
  errors.bias = over_time([&](std::size_t i) { return bias_error_dps(series, track, i); });
  errors.covariance = covariance_statistics(series, track);
  return errors;
}

}  // namespace gyrostat
