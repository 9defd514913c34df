#pragma once

#include <algorithm>
#include <cmath>

namespace gyrostat::gap {

/// Innovations of values about a level that walks, in units of the values' white noise: the Kalman
/// filter of the local level model from a diffuse start (Harvey, "Forecasting, Structural Time
/// Series Models and the Kalman Filter", 1989, 4.1.2), its gain never below that of its steady
/// state. At a gain of 0 the level stands still, and squares add up to those about the mean.
class WalkingLevel {
 public:
  explicit WalkingLevel(double gain)
      : gain_(gain), root_known_(std::sqrt(1.0 - gain)), log_of_known_(std::log(1.0 - gain)) {}

  /// 0 of the first value.
  double innovation(double value) {
    const double gain = std::max(gain_, 1.0 / ++count_);
    const double known = 1.0 - gain, off = value - level_;
    level_ += gain * off;
    if (gain == gain_) {
      log_known_ += log_of_known_;
      return root_known_ * off;
    }
    if (known <= 0.0) return 0.0;
    log_known_ += std::log(known);
    return std::sqrt(known) * off;
  }
  /// Logarithm of the white noise's share of the variance, summed up over all innovations.
  double log_known() const { return log_known_; }

 private:
  double gain_, root_known_, log_of_known_, count_ = 0.0, level_ = 0.0, log_known_ = 0.0;
};

}  // namespace gyrostat::gap
