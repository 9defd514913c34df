#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <gyrostat/diagnosis/likelihood/slow_recursion.hpp>

namespace gyrostat::gap {

/// Histories of jumps side by side: of each a lane, with the likelihood so far, the level (of two:
/// +1 or -1 times half their distance) and what it makes of the states. What each does is what a
/// SlowRecursion and an SlowEstimate of its own would.
template <int N>
class JumpHistories {
 public:
  static constexpr std::size_t most_kept = 12;
  static constexpr std::size_t lanes = 16;
  static_assert(lanes >= most_kept + 2);
  using Lanes = std::array<double, lanes>;

  /// Those of a change between two levels leave what is known of the states as it is: they share
  /// one recursion.
  JumpHistories(const SlowLaw& still, const Jumps& jumps)
      : common_(still), is_of_two_(jumps.to == Jumps::To::the_other_level) {
    size_ = is_of_two_ ? 2 : 1;
    for (std::size_t h = 0; h < size_; ++h) {
      log_weight_[h] = is_of_two_ ? std::log(0.5) : 0.0;
      level_[h] = is_of_two_ ? (h == 0 ? -jumps.size_dps : jumps.size_dps) : 0.0;
      for (int i = 0; i < states(); ++i) at(i, i)[h] = motion().first_variance[i];
    }
  }

  /// From one value to the next: each history goes on, and of the likeliest on each level one is
  /// born that jumps now.
  void predict(std::size_t steps, const Jumps& jumps, double interval_s) {
    if (steps != steps_) {
      const double mean = jumps.per_s * interval_s * static_cast<double>(steps);
      const double jump = is_of_two_ ? 0.5 * -std::expm1(-2.0 * mean) : -std::expm1(-mean);
      log_jump_ = std::log(jump);
      log_none_ = std::log1p(-jump);
      left_ = motion().decays(steps);
      gained_ = motion().drives(steps, left_);
      steps_ = steps;
    }
    if (is_of_two_)
      common_.predict(steps);
    else
      predict_covariances();
    for (int i = 1; i < states(); ++i)
      for (std::size_t h = 0; h < lanes; ++h) state_[i][h] *= left_[i];
    const std::size_t before = size_;
    if (is_of_two_)
      for (const double from : {-jumps.size_dps, jumps.size_dps}) bear(before, from, 0.0);
    else
      bear(before, 0.0, jumps.size_dps * jumps.size_dps);
    for (std::size_t h = 0; h < before; ++h) log_weight_[h] += log_none_;
  }

  /// Takes a value in; the first one tells nothing of the weights.
  void update(double value, bool is_first) {
    if (is_of_two_)
      common_.update();
    else
      update_covariances();
    Lanes expected{};
    for (int i = 0; i < states(); ++i)
      for (std::size_t h = 0; h < lanes; ++h) expected[h] += state_[i][h];
    Lanes innovation;
    for (std::size_t h = 0; h < lanes; ++h) innovation[h] = value - level_[h] - expected[h];
    for (int i = 0; i < states(); ++i)
      if (is_of_two_)
        for (std::size_t h = 0; h < lanes; ++h) state_[i][h] += common_.gain()[i] * innovation[h];
      else
        for (std::size_t h = 0; h < lanes; ++h) state_[i][h] += gain_[i][h] * innovation[h];
    if (is_first) return;
    for (std::size_t h = 0; h < size_; ++h) {
      const double variance = is_of_two_ ? common_.variance() : variance_[h];
      const double log_variance = is_of_two_ ? common_.log_variance() : log_variance_[h];
      log_weight_[h] -=
          0.5 * (log_two_pi + log_variance + innovation[h] * innovation[h] / variance);
    }
  }

  /// Makes the weights add up to 1, and returns the logarithm of what they added up to.
  double normalise() {
    double most = -1e300;
    for (std::size_t h = 0; h < size_; ++h) most = std::max(most, log_weight_[h]);
    double total = 0.0;
    for (std::size_t h = 0; h < size_; ++h) total += std::exp(log_weight_[h] - most);
    const double by = most + std::log(total);
    for (std::size_t h = 0; h < size_; ++h) log_weight_[h] -= by;
    return by;
  }

  void keep_the_likeliest() {
    while (size_ > most_kept) {
      const auto last = log_weight_.begin() + static_cast<std::ptrdiff_t>(size_);
      const auto least = static_cast<std::size_t>(std::min_element(log_weight_.begin(), last) -
                                                  log_weight_.begin());
      --size_;
      if (least != size_) copy(size_, least);
    }
  }

 private:
  const SlowMotion<N>& motion() const { return common_.motion(); }
  int states() const { return common_.states(); }
  Lanes& at(int i, int j) { return covariance_[static_cast<std::size_t>(i * N + j)]; }

  void copy(std::size_t from, std::size_t to) {
    log_weight_[to] = log_weight_[from];
    level_[to] = level_[from];
    for (int i = 0; i < states(); ++i) state_[i][to] = state_[i][from];
    if (is_of_two_) return;
    variance_[to] = variance_[from];
    log_variance_[to] = log_variance_[from];
    settled_[to] = settled_[from];
    for (int i = 0; i < states(); ++i) {
      gain_[i][to] = gain_[i][from];
      for (int j = 0; j < states(); ++j) at(i, j)[to] = at(i, j)[from];
    }
  }

  /// Of the first `among`, the likeliest on a level has a child.
  void bear(std::size_t among, double from, double widened_by) {
    std::size_t parent = among;
    double share = 0.0;
    for (std::size_t h = 0; h < among; ++h) {
      if (level_[h] != from) continue;
      if (parent == among || log_weight_[h] > log_weight_[parent]) parent = h;
      share += std::exp(log_weight_[h]);
    }
    if (parent == among) return;
    const std::size_t child = size_++;
    copy(parent, child);
    log_weight_[child] = std::log(std::max(share, 1e-300)) + log_jump_;
    level_[child] = -from;
    if (is_of_two_) return;
    at(0, 0)[child] += widened_by;
    settled_[child] = 0.0;
  }

  void predict_covariances() {
    if (steps_ != 1) settled_.fill(0.0);
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j < states(); ++j) {
        auto& covariance = at(i, j);
        const double left = left_[i] * left_[j], gained = i == j ? gained_[i] : 0.0;
        for (std::size_t h = 0; h < lanes; ++h) {
          const double next = i == j ? covariance[h] * left + gained : covariance[h] * left;
          covariance[h] = settled_[h] != 0.0 ? covariance[h] : next;
        }
      }
  }

  void update_covariances() {
    std::array<Lanes, N> row{};
    Lanes innovation, moved;
    innovation.fill(motion().white);
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j < states(); ++j)
        for (std::size_t h = 0; h < lanes; ++h) row[i][h] += at(i, j)[h];
    for (int i = 0; i < states(); ++i)
      for (std::size_t h = 0; h < lanes; ++h) innovation[h] += row[i][h];
    for (std::size_t h = 0; h < lanes; ++h)
      moved[h] = std::abs(innovation[h] - variance_[h]) / innovation[h];
    for (int i = 0; i < states(); ++i)
      for (std::size_t h = 0; h < lanes; ++h) {
        const double gain = row[i][h] / innovation[h], by = std::abs(gain - gain_[i][h]);
        moved[h] = moved[h] < by ? by : moved[h];
        gain_[i][h] = settled_[h] != 0.0 ? gain_[i][h] : gain;
      }
    for (std::size_t h = 0; h < size_; ++h)
      if (settled_[h] == 0.0) log_variance_[h] = std::log(innovation[h]);
    for (std::size_t h = 0; h < lanes; ++h)
      variance_[h] = settled_[h] != 0.0 ? variance_[h] : innovation[h];
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j < states(); ++j) {
        auto& covariance = at(i, j);
        for (std::size_t h = 0; h < lanes; ++h) {
          const double next = covariance[h] - gain_[i][h] * row[j][h];
          covariance[h] = settled_[h] != 0.0 ? covariance[h] : next;
        }
      }
    for (std::size_t h = 0; h < lanes; ++h)
      settled_[h] = settled_[h] != 0.0 || (steps_ == 1 && moved[h] < 1e-9) ? 1.0 : 0.0;
  }

  SlowRecursion<N> common_;
  bool is_of_two_;
  std::size_t size_ = 0, steps_ = 0;
  double log_jump_ = 0.0, log_none_ = 0.0;
  std::array<double, N> left_{}, gained_{};
  alignas(64) Lanes log_weight_{}, level_{}, variance_{}, log_variance_{}, settled_{};
  std::array<Lanes, N> state_{}, gain_{};
  std::array<Lanes, N * N> covariance_{};
};

}  // namespace gyrostat::gap
