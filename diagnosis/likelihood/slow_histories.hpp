#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <gyrostat/diagnosis/likelihood/jump_trail.hpp>
#include <gyrostat/diagnosis/likelihood/slow_recursion.hpp>

namespace gyrostat::gap {

/// Histories of jumps side by side: of each a lane, with its probability, the level (of two: +1 or
/// -1 times half their distance) and what it makes of the states. From value to value those on a
/// level have one child that jumps, and two that say nearly the same become one of their mean and
/// covariance: many unlikely histories say together what none of them says alone (Salmond, IEEE
/// Trans. AES-45, 2009).
template <int N>
class JumpHistories {
 public:
  static constexpr std::size_t most_kept = 6;
  /// Two levels have a child each.
  static constexpr std::size_t lanes = most_kept + 2;
  using Lanes = std::array<double, lanes>;
  using Trail = JumpTrail<lanes>;

  /// Writes down in `trail`, where there is one, which of two levels each value is on (-1 or 1), or
  /// else where the level jumps (0 or 1).
  JumpHistories(const SlowLaw& still, const Jumps& jumps, Trail* trail = nullptr)
      : motion_(still),
        jumps_(jumps),
        trail_(trail),
        interval_s_(still.interval_s),
        size_(is_of_two() ? 2 : 1) {
    for (std::size_t h = 0; h < size_; ++h) {
      weight_[h] = 1.0 / static_cast<double>(size_);
      if (is_of_two()) level_[h] = h == 0 ? -jumps.size_dps : jumps.size_dps;
      for (int i = 0; i < states(); ++i) at(i, i)[h] = motion_.first_variance[i];
    }
    if (trail_ != nullptr) trail_->begin(said_by_level());
  }

  void predict(std::size_t steps) {
    if (steps != steps_) {
      const double mean = jumps_.per_s * interval_s_ * static_cast<double>(steps);
      jump_ = is_of_two() ? 0.5 * -std::expm1(-2.0 * mean) : -std::expm1(-mean);
      left_ = motion_.decays(steps);
      gained_ = motion_.drives(steps, left_);
      steps_ = steps;
    }
    for (int i = 0; i < states(); ++i)
      for (std::size_t h = 0; h < lanes; ++h) state_[i][h] *= left_[i];
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j <= i; ++j) {
        const double left = left_[i] * left_[j], gained = i == j ? gained_[i] : 0.0;
        for (std::size_t h = 0; h < lanes; ++h) at(i, j)[h] = at(i, j)[h] * left + gained;
      }
    bear();
  }

  /// Takes a value in, and returns the logarithm of its density.
  double update(double value) {
    find_expectations();
    Lanes innovation, exponent;
    for (std::size_t h = 0; h < lanes; ++h) innovation[h] = value - level_[h] - expected_[h];
    std::array<Lanes, N> gain;
    for (int i = 0; i < states(); ++i)
      for (std::size_t h = 0; h < lanes; ++h) {
        gain[i][h] = row_[i][h] / variance_[h];
        state_[i][h] += gain[i][h] * innovation[h];
      }
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j <= i; ++j)
        for (std::size_t h = 0; h < lanes; ++h) at(i, j)[h] -= gain[i][h] * row_[j][h];
    double most = -1e300;
    for (std::size_t h = 0; h < size_; ++h) {
      exponent[h] = -0.5 * (std::log(variance_[h]) + innovation[h] * innovation[h] / variance_[h]);
      if (weight_[h] > 0.0) most = std::max(most, exponent[h]);
    }
    double total = 0.0;
    for (std::size_t h = 0; h < size_; ++h)
      if (weight_[h] > 0.0) total += weight_[h] *= std::exp(exponent[h] - most);
    for (std::size_t h = 0; h < size_; ++h) weight_[h] /= total;
    return most + std::log(total) - 0.5 * log_two_pi;
  }

  /// Writes down what is old enough to be known, or, at the end, all.
  void settle(bool at_the_end) {
    if (trail_ == nullptr) return;
    Lanes weights{};
    for (std::size_t h = 0; h < size_; ++h) weights[h] = weight_[h];
    trail_->settle(weights, at_the_end);
  }

  /// Leaves most_kept of them.
  void reduce() {
    if (size_ <= most_kept) return;
    find_expectations();
    while (size_ > most_kept) {
      std::size_t one = 0, other = 1;
      double least = 1e300;
      for (std::size_t h = 1; h < size_; ++h) {
        const Lanes losses = losses_with(h);
        for (std::size_t g = 0; g < h; ++g)
          if (losses[g] < least) least = losses[g], one = g, other = h;
      }
      join(other, one);
      if (--size_ != other) copy(size_, other);
    }
  }

 private:
  bool is_of_two() const { return jumps_.to == Jumps::To::the_other_level; }
  int states() const { return motion_.states(); }
  /// Of states j <= i.
  Lanes& at(int i, int j) { return covariance_[static_cast<std::size_t>(i * (i + 1) / 2 + j)]; }

  /// What each expects of the next value but for its level, how surely, and how it goes with the
  /// states.
  void find_expectations() {
    expected_.fill(0.0);
    variance_.fill(motion_.white);
    row_ = {};
    for (int i = 0; i < states(); ++i) {
      for (int j = 0; j < i; ++j)
        for (std::size_t h = 0; h < lanes; ++h) {
          row_[i][h] += at(i, j)[h];
          row_[j][h] += at(i, j)[h];
        }
      for (std::size_t h = 0; h < lanes; ++h) row_[i][h] += at(i, i)[h];
    }
    for (int i = 0; i < states(); ++i)
      for (std::size_t h = 0; h < lanes; ++h) {
        expected_[h] += state_[i][h];
        variance_[h] += row_[i][h];
      }
  }

  /// What is lost where h and each other becomes one: their divergence (Jeffreys 1946) times what
  /// both weigh.
  Lanes losses_with(std::size_t h) const {
    Lanes losses;
    for (std::size_t g = 0; g < lanes; ++g) {
      const double apart = expected_[g] - expected_[h], wider = variance_[g] - variance_[h];
      const double divergence = (apart * apart * (variance_[g] + variance_[h]) + wider * wider) /
                                (variance_[g] * variance_[h]);
      const double loss =
          divergence * weight_[g] * weight_[h] / std::max(weight_[g] + weight_[h], 1e-300);
      losses[g] = level_[g] == level_[h] ? loss : 1e300;
    }
    return losses;
  }

  void bear() {
    const std::size_t parents = size_;
    if (is_of_two())
      for (const double level : {-jumps_.size_dps, jumps_.size_dps}) bear(parents, level);
    else
      bear(parents, 0.0);
    for (std::size_t h = 0; h < parents; ++h) weight_[h] *= 1.0 - jump_;
    if (trail_ == nullptr) return;
    Lanes said = said_by_level();
    if (!is_of_two()) said[parents] = 1.0;
    trail_->step(said);
  }
  /// Where the level has not jumped.
  Lanes said_by_level() const {
    Lanes said{};
    for (std::size_t h = 0; h < lanes && is_of_two(); ++h) said[h] = level_[h] < 0.0 ? -1.0 : 1.0;
    return said;
  }
  /// The child of those of the parents that are on a level, of their mean and covariance.
  void bear(std::size_t parents, double level) {
    Lanes share{};
    for (std::size_t h = 0; h < parents; ++h) share[h] = level_[h] == level ? weight_[h] : 0.0;
    const double total = sum(share);
    if (!(total > 0.0)) return;
    for (double& s : share) s /= total;
    std::array<Lanes, N> apart, shared;
    std::array<double, N> mean;
    for (int i = 0; i < states(); ++i) {
      for (std::size_t h = 0; h < lanes; ++h) shared[i][h] = share[h] * state_[i][h];
      mean[i] = sum(shared[i]);
      for (std::size_t h = 0; h < lanes; ++h) {
        apart[i][h] = state_[i][h] - mean[i];
        shared[i][h] = share[h] * apart[i][h];
      }
    }
    const std::size_t child = size_++;
    for (int i = 0; i < states(); ++i) {
      state_[i][child] = mean[i];
      for (int j = 0; j <= i; ++j) {
        Lanes both;
        for (std::size_t h = 0; h < lanes; ++h)
          both[h] = share[h] * at(i, j)[h] + shared[i][h] * apart[j][h];
        at(i, j)[child] = sum(both);
      }
    }
    if (trail_ != nullptr) trail_->bear(share, child);
    weight_[child] = total * jump_;
    level_[child] = -level;
    if (!is_of_two()) at(0, 0)[child] += jumps_.size_dps * jumps_.size_dps;
  }
  static double sum(const Lanes& of) {
    static_assert(lanes == 8);
    return ((of[0] + of[4]) + (of[2] + of[6])) + ((of[1] + of[5]) + (of[3] + of[7]));
  }

  /// `into` becomes both of them, of their mean and covariance.
  void join(std::size_t from, std::size_t into) {
    const double both = weight_[from] + weight_[into];
    if (both == 0.0) return;
    const double share = weight_[from] / both;
    std::array<double, N> apart;
    for (int i = 0; i < states(); ++i) {
      apart[i] = state_[i][from] - state_[i][into];
      state_[i][into] += share * apart[i];
    }
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j <= i; ++j)
        at(i, j)[into] +=
            share * (at(i, j)[from] - at(i, j)[into] + (1.0 - share) * apart[i] * apart[j]);
    expected_[into] += share * (expected_[from] - expected_[into]);
    variance_[into] += share * (variance_[from] - variance_[into]);
    weight_[into] = both;
    if (trail_ != nullptr) trail_->join(from, into, share);
  }

  void copy(std::size_t from, std::size_t to) {
    weight_[to] = weight_[from];
    level_[to] = level_[from];
    expected_[to] = expected_[from];
    variance_[to] = variance_[from];
    for (int i = 0; i < states(); ++i) {
      state_[i][to] = state_[i][from];
      for (int j = 0; j <= i; ++j) at(i, j)[to] = at(i, j)[from];
    }
    if (trail_ != nullptr) trail_->copy(from, to);
  }

  SlowMotion<N> motion_;
  Jumps jumps_;
  Trail* trail_;
  double interval_s_, jump_ = 0.0;
  std::size_t size_, steps_ = 0;
  std::array<double, N> left_{}, gained_{};
  alignas(64) Lanes weight_{}, level_{}, expected_{}, variance_{};
  std::array<Lanes, N> state_{}, row_{};
  std::array<Lanes, N*(N + 1) / 2> covariance_{};
};

}  // namespace gyrostat::gap
