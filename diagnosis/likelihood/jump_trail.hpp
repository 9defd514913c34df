#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace gyrostat::gap {

/// What histories of jumps say of each step, long enough after it to know: of each history a ring
/// of its last steps, of histories that became one the mean over both.
template <std::size_t lanes>
class JumpTrail {
 public:
  using Lanes = std::array<double, lanes>;
  /// Later steps hardly say more of one.
  static constexpr std::size_t remembered = 64;

  /// What each history says of the first value.
  void begin(const Lanes& said) { write(said); }
  /// What each says of the next one.
  void step(const Lanes& said) {
    ++steps_;
    write(said);
  }
  /// Before each further step, with the histories' weights; `all` at the end.
  void settle(const Lanes& weights, bool all = false) {
    while (settled_.size() + (all ? 0 : remembered - 1) <= steps_) {
      const std::size_t at = settled_.size() % remembered;
      double mean = 0.0;
      for (std::size_t h = 0; h < lanes; ++h) mean += weights[h] * said_[h][at];
      settled_.push_back(mean);
    }
  }
  void bear(const Lanes& shares, std::size_t child) {
    std::array<double, remembered> mean{};
    for (std::size_t h = 0; h < lanes; ++h)
      for (std::size_t at = 0; at < remembered; ++at) mean[at] += shares[h] * said_[h][at];
    said_[child] = mean;
  }
  void join(std::size_t from, std::size_t into, double share) {
    for (std::size_t at = 0; at < remembered; ++at)
      said_[into][at] += share * (said_[from][at] - said_[into][at]);
  }
  void copy(std::size_t from, std::size_t to) { said_[to] = said_[from]; }

  /// The mean over the histories, a value for each.
  const std::vector<double>& settled() const { return settled_; }

 private:
  void write(const Lanes& said) {
    for (std::size_t h = 0; h < lanes; ++h) said_[h][steps_ % remembered] = said[h];
  }

  std::array<std::array<double, remembered>, lanes> said_{};
  std::vector<double> settled_;
  std::size_t steps_ = 0;
};

}  // namespace gyrostat::gap
