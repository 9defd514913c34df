#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <gyrostat/analysis/innovations.hpp>
#include <gyrostat/core/track.hpp>

namespace gyrostat {

/// Compensated rate minus true rate, dps, at sample i: z - x_hat in the papers' static experiments.
/// Without a rate reference the gyro counts as static. NaN where the gyro value is missing.
inline double rate_error_dps(const Series& series, const Track& track, std::size_t i) {
  const double rate = series.rate_ref_dps.empty() ? 0.0 : series.rate_ref_dps[i];
  return series.gyro_dps[i] - track.estimate_dps[i] - rate;
}

/// Estimate minus the gyro's true correlated error, drift and random error together, dps.
inline double bias_error_dps(const Series& series, const Track& track, std::size_t i) {
  return track.estimate_dps[i] - series.thermal_bias_dps[i] - series.random_error_dps[i];
}

inline bool has_truth(const Series& series) {
  return !series.thermal_bias_dps.empty() && !series.random_error_dps.empty();
}

struct ErrorMoments {
  std::size_t count = 0;
  double mean = no_value;
  double std = no_value;
  double rmse = no_value;
};

/// Moments over time of `error(i)`, i < samples; NaN samples are left out.
template <class Error>
ErrorMoments error_moments(std::size_t samples, const Error& error) {
  double sum = 0.0, squares = 0.0, spread = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const double e = error(i);
    if (std::isnan(e)) continue;
    sum += e;
    squares += e * e;
    ++count;
  }
  if (count == 0) return {};
  const double n = static_cast<double>(count), mean = sum / n;
  for (std::size_t i = 0; i < samples; ++i) {
    const double e = error(i);
    if (!std::isnan(e)) spread += (e - mean) * (e - mean);
  }
  return {count, mean, std::sqrt(spread / n), std::sqrt(squares / n)};
}

/// Integral of the rate error, deg, from 0 at the first sample; a missing gyro value adds nothing.
struct HeadingExcursion {
  double end_deg = 0.0;
  double min_deg = 0.0;
  double max_deg = 0.0;
};

/// How the bias error compares with the variance that the filter states, over time. No values for a
/// filter that states none.
struct StatedCovariance {
  double nees = no_value;            ///< mean of bias error^2 / variance
  double nees_end = no_value;        ///< the same at the last sample alone
  double within_1_sigma = no_value;  ///< share of samples
  double within_3_sigma = no_value;
};

/// Everything that metrics read of a track, computed once.
struct TrackErrors {
  ErrorMoments rate;  ///< dps
  ErrorMoments bias;  ///< dps; empty without the truth
  Innovations innovations;
  StatedCovariance covariance;  ///< empty without the truth
  HeadingExcursion heading;
  std::array<double, status_names.size()> steps{};  ///< of each Status
  double first_breakdown_s = no_value;  ///< time of the first step that was left out, if any
  LearnedParameters learned_first, learned_last;
};

TrackErrors track_errors(const Series& series, const Track& track);

}  // namespace gyrostat
