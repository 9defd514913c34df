#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <gyrostat/generators/sampled.hpp>

namespace gyrostat {

/// A stationary Gauss-Markov process, exact between samples, even or not.
class Wander {
 public:
  Wander(const NormalStream& stream, double std, double time_s)
      : drive_(stream), decay_(time_s), std_(std) {}

  /// At sample i, the next one.
  double operator()(const std::vector<double>& t_s, std::size_t i) {
    const double kept = decay_(t_s, i);
    value_ = kept * value_ + std_ * std::sqrt((1.0 - kept) * (1.0 + kept)) * drive_.next();
    return value_;
  }

 private:
  Deviates drive_;
  Decay decay_;
  double std_, value_ = 0.0;
};

}  // namespace gyrostat
