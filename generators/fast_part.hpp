#pragma once

#include <cstddef>
#include <vector>

#include <gyrostat/generators/sampled.hpp>

namespace gyrostat {

/// What a signal does within a second: its value less its exponentially weighted mean over a second
/// of the past, which slow errors and the response to a motion are left to.
class FastPart {
 public:
  static constexpr double window_s = 1.0;

  /// Of sample i; 0 at the first.
  double operator()(const std::vector<double>& t_s, std::size_t i, double value) {
    const double kept = decay_(t_s, i);
    mean_ = kept * mean_ + (1.0 - kept) * value;
    return value - mean_;
  }

 private:
  Decay decay_{window_s};
  double mean_ = 0.0;
};

}  // namespace gyrostat
