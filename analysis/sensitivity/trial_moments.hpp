#pragma once

#include <cmath>
#include <span>
#include <vector>

#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// What trials tell of an expected value: their mean, and the variance that it has from trial to
/// trial.
struct TrialMean {
  double mean = no_value;
  double variance = no_value;

  /// Unbiased for the square of the expected value: the mean of all products of two different
  /// trials.
  double square() const { return mean * mean - variance; }
  /// What the noise adds to the absolute value of the mean on average, were its expected value
  /// `mean`: E|mean + e| - |mean| with normal e.
  double excess() const;
  /// For the absolute value of the expected value, which no estimate is unbiased for: |mean| -
  /// excess(). Right on average over expected values that are spread more widely than the noise;
  /// too large by half a standard error where they are zero.
  double magnitude() const { return std::abs(mean) - excess(); }
};

/// Of those trials that have a value (not NaN): of all, then with each trial left out in turn, so
/// one entry more than trials. No values, no mean. A single value has no spread; its variance
/// counts as zero.
std::vector<TrialMean> trial_means(std::span<const double> values);

}  // namespace gyrostat
