#pragma once

#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

/// What a gyro without noise and drift says under the conditions of a recording: as
/// synthesise_rate_under, bit for bit, for effects that act on the gyro, in a fraction of the time.
///
/// Thread safety: may be asked from any number of threads.
class GyroResponse {
 public:
  explicit GyroResponse(const Series& conditions);

  /// With no effect: the reference rate, NaN where the recording has no gyro.
  const std::vector<double>& still() const { return still_dps_; }
  /// With effects of the stages after Stage::sensing.
  std::vector<double> of(const std::vector<Effect>& effects) const;

 private:
  std::vector<double> still_dps_;
  std::vector<std::size_t> gaps_;
  Series prepared_;  ///< conditions that are held where they are missing
  /// A copy for each thread, whose gyro alone is written.
  mutable tbb::enumerable_thread_specific<Series> work_;
};

}  // namespace gyrostat::gap
