#include <gyrostat/analysis/errors.hpp>

#include <algorithm>

namespace gyrostat {
namespace {

/// The heading as it grows, sample by sample.
struct Heading {
  HeadingExcursion excursion;

  void add(double rate_error_dps, double interval_s) {
    auto& [end_deg, min_deg, max_deg] = excursion;
    if (!std::isnan(rate_error_dps)) end_deg += rate_error_dps * interval_s;
    min_deg = std::min(min_deg, end_deg);
    max_deg = std::max(max_deg, end_deg);
  }
};

/// Bias errors beside the variances stated for them, sample by sample.
struct Covariance {
  double sum = 0.0, last = no_value;
  std::size_t count = 0, within_1 = 0, within_3 = 0;

  void add(double bias_error_dps, double variance) {
    const double squared = bias_error_dps * bias_error_dps / variance;
    if (std::isnan(squared)) return;
    ++count;
    sum += squared;
    within_1 += squared <= 1.0;
    within_3 += squared <= 9.0;
    last = squared;
  }

  StatedCovariance statistics() const {
    if (count == 0) return {};
    const double n = static_cast<double>(count);
    return {sum / n, last, static_cast<double>(within_1) / n, static_cast<double>(within_3) / n};
  }
};

}  // namespace

HeadingExcursion heading_excursion(const Series& series, const Track& track) {
  Heading heading;
  for (std::size_t i = 1; i < series.size(); ++i)
    heading.add(rate_error_dps(series, track, i), series.t_s[i] - series.t_s[i - 1]);
  return heading.excursion;
}

StatedCovariance covariance_statistics(const Series& series, const Track& track) {
  Covariance covariance;
  for (std::size_t i = 0; i < series.size(); ++i)
    covariance.add(bias_error_dps(series, track, i), track.estimate_variance[i]);
  return covariance.statistics();
}

TrackErrors track_errors(const Series& series, const Track& track) {
  // Sums wait for themselves alone, so side by side they cost little more than one of them.
  const bool truth = has_truth(series);
  MomentSums rate, bias;
  Heading heading;
  Covariance covariance;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double error = rate_error_dps(series, track, i);
    rate.add(error);
    if (i > 0) heading.add(error, series.t_s[i] - series.t_s[i - 1]);
    if (!truth) continue;
    const double own = bias_error_dps(series, track, i);
    bias.add(own);
    covariance.add(own, track.estimate_variance[i]);
  }
  rate.centre();
  bias.centre();
  for (std::size_t i = 0; i < series.size(); ++i) {
    rate.add_centred(rate_error_dps(series, track, i));
    if (truth) bias.add_centred(bias_error_dps(series, track, i));
  }

  TrackErrors errors;
  errors.rate = rate.moments();
  errors.innovations = innovation_statistics(track);
  errors.heading = heading.excursion;
  const auto broken = std::find_if(track.status.begin(), track.status.end(), is_breakdown);
  if (broken != track.status.end())
    errors.first_breakdown_s = series.t_s[broken - track.status.begin()] - series.t_s.front();
  errors.learned_first = track.learned_first;
  errors.learned_last = track.learned_last;
  if (!truth) return errors;
  errors.bias = bias.moments();
  errors.covariance = covariance.statistics();
  return errors;
}

}  // namespace gyrostat
