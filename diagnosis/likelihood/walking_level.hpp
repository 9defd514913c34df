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
    const double off = value - level_;
    if (gain_ * (count_ + 1.0) >= 1.0) {
      ++steady_;
      level_ += gain_ * off;
      return root_known_ * off;
    }
    const double gain = 1.0 / ++count_;
    level_ += gain * off;
    return std::sqrt(1.0 - gain) * off;
  }
  /// Logarithm of the white noise's share of the variance, summed up over all innovations: shares
  /// of 1/2, 2/3, … multiply to one over their count.
  double log_known() const { return steady_ * log_of_known_ - std::log(std::max(count_, 1.0)); }

 private:
  double gain_, root_known_, log_of_known_, count_ = 0.0, steady_ = 0.0, level_ = 0.0;
};

}  // namespace gyrostat::gap
