#pragma once

#include <cstddef>

namespace gyrostat::gap {

/// What histories of jumps say of each step, long enough after it to know: of each history a ring
/// of its last steps, of histories that became one the mean over both. Compiled for each
/// instruction set by itself, which is why `Target` is in the type.
template <class Target, int lanes>
class JumpTrail {
 public:
  /// Later steps hardly say more of one.
  static constexpr std::size_t remembered = 64;

  /// Writes the mean over the histories into `settled`, a value for each step.
  explicit JumpTrail(double* settled) : settled_(settled) {}

  /// What each history says of the next value.
  void step(const double* said) {
    for (int h = 0; h < lanes; ++h) said_[h][steps_ % remembered] = said[h];
    ++steps_;
  }
  /// Before each further step, with the histories' weights; `all` at the end.
  void settle(const double* weights, bool all) {
    for (; count_ + (all ? 0 : remembered - 1) < steps_; ++count_) {
      double mean = 0.0;
      for (int h = 0; h < lanes; ++h) mean += weights[h] * said_[h][count_ % remembered];
      settled_[count_] = mean;
    }
  }
  void bear(const double* shares, int child) {
    alignas(64) double mean[remembered] = {};
    for (int h = 0; h < lanes; ++h) {
      if (shares[h] == 0.0) continue;
      for (std::size_t at = 0; at < remembered; ++at) mean[at] += shares[h] * said_[h][at];
    }
    for (std::size_t at = 0; at < remembered; ++at) said_[child][at] = mean[at];
  }
  void join(int from, int into, double share) {
    for (std::size_t at = 0; at < remembered; ++at)
      said_[into][at] += share * (said_[from][at] - said_[into][at]);
  }
  void copy(int from, int to) {
    for (std::size_t at = 0; at < remembered; ++at) said_[to][at] = said_[from][at];
  }

 private:
  alignas(64) double said_[lanes][remembered] = {};
  double* settled_;
  std::size_t steps_ = 0, count_ = 0;
};

}  // namespace gyrostat::gap
