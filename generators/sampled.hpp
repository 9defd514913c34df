#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>

namespace gyrostat {

/// The number of samples of a series that has all the `needs`, else 0: what an effect loops over.
template <std::size_t N>
std::size_t samples_with(const Series& series,
                         const std::array<std::vector<double> Series::*, N>& needs) {
  std::size_t samples = series.size();
  for (const auto channel : needs) samples = std::min(samples, (series.*channel).size());
  return samples;
}

/// What the gyro of sample i is beside the true rate, thermal drift and random error: all that
/// there is of white noise while that alone has been added.
inline double error_beside_drift(const Series& series, std::size_t i) {
  return series.gyro_dps[i] - series.rate_ref_dps[i] - series.thermal_bias_dps[i] -
         series.random_error_dps[i];
}

/// The deviates of a stream one after the other, drawn by the block.
class Deviates {
 public:
  explicit Deviates(const NormalStream& stream) : stream_(stream) {}

  double next() {
    if (at_ == block_.size()) {
      stream_.fill(drawn_, block_);
      drawn_ += block_.size();
      at_ = 0;
    }
    return block_[at_++];
  }

 private:
  NormalStream stream_;
  std::array<double, 64> block_{};
  std::size_t at_ = block_.size();
  std::uint64_t drawn_ = 0;
};

/// exp(-dt / time constant) from one sample to the next, whatever the intervals. It is computed
/// anew where the interval changes by more than a millionth, so that an even series costs one
/// exponential.
class Decay {
 public:
  explicit Decay(double time_constant_s) : time_constant_s_(time_constant_s) {}

  /// From sample i - 1 to sample i; 0 at the first, which remembers nothing.
  double operator()(const std::vector<double>& t_s, std::size_t i) {
    return i == 0 ? 0.0 : over(t_s[i] - t_s[i - 1]);
  }

  double over(double interval_s) {
    if (!(std::abs(interval_s - interval_s_) <= 1e-6 * interval_s_)) {
      interval_s_ = interval_s;
      value_ = std::exp(-std::max(interval_s, 0.0) / time_constant_s_);
    }
    return value_;
  }

 private:
  double time_constant_s_;
  double interval_s_ = std::numeric_limits<double>::quiet_NaN();
  double value_ = 1.0;
};

}  // namespace gyrostat
