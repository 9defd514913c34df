#pragma once

#include <cstddef>

#include <gyrostat/core/numerics/lanes.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat {

/// A stretch of the steps of some trials in lanes, beside what they are judged against: the value
/// of lane l at sample k of each channel is at [k * lanes + l]. A Track and its Series are one
/// lane.
struct JudgedSteps {
  /// So many at most, so that what is computed of them on the way stays in the first-level cache.
  static constexpr std::size_t most = 64;

  std::size_t samples = 0;
  const double* t_s = nullptr;
  const double* gyro_dps = nullptr;
  const double* true_rate_dps = nullptr;     ///< null: static
  const double* true_drift_dps = nullptr;    ///< null: no truth
  const double* random_error_dps = nullptr;  ///< null: no truth
  const double* estimate_dps = nullptr;
  const double* estimate_variance = nullptr;
  const double* innovation_dps = nullptr;
  const double* innovation_variance = nullptr;
  const double* status = nullptr;  ///< the number of a Status

  bool has_truth() const { return true_drift_dps != nullptr && random_error_dps != nullptr; }
};

namespace judge {

/// Whether no lane has a value anywhere, as of a method that states none, or between two epochs of
/// one that has few.
template <class T>
bool all_missing(const double* values, std::size_t samples) {
  Mask<T> missing = is_missing(Lanes<T>::load(values));
  for (std::size_t k = 1; k < samples && all(missing); ++k)
    missing = missing && is_missing(Lanes<T>::load(values + k * Lanes<T>::count));
  return all(missing);
}

}  // namespace judge
}  // namespace gyrostat
