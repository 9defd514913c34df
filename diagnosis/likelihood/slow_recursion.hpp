#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gyrostat/diagnosis/likelihood/slow_filter.hpp>

namespace gyrostat::gap {

/// Up to so many states, a filter is compiled for each number.
inline constexpr int counted_states = 9;
inline const double log_two_pi = std::log(2.0 * std::numbers::pi);

/// A level, its decaying errors, and two for each of those that turn.
inline std::size_t states_of(const SlowLaw& law) {
  return 1 + law.parts.size() + 2 * law.turning.size();
}

/// How the states of a law move, for at most N of them: the level, then its decaying errors, then
/// those that turn, in axes that turn with them: there they decay as the others do.
template <int N>
class SlowMotion {
 public:
  explicit SlowMotion(const SlowLaw& law)
      : white(law.white), states_(std::min(N, static_cast<int>(states_of(law)))) {
    decay_[0] = 1.0;
    drive_[0] = law.walk;
    double total = std::abs(law.white);
    auto parts = law.parts;
    for (const auto& turning : law.turning)
      parts.insert(parts.end(), 2, {turning.variance, turning.decay});
    for (int i = 1; i < states(); ++i) {
      const auto& part = parts[static_cast<std::size_t>(i - 1)];
      decay_[i] = part.decay;
      drive_[i] = part.variance * (1.0 - part.decay) * (1.0 + part.decay);
      first_variance[i] = part.variance;
      total += std::abs(part.variance);
    }
    first_variance[0] = 1e7 * (total + law.walk);
  }

  int states() const { return N <= counted_states ? N : states_; }
  /// What is left of each state after so many steps.
  std::array<double, N> decays(std::size_t steps) const {
    if (steps == 1) return decay_;
    std::array<double, N> left{};
    for (int i = 0; i < states(); ++i) left[i] = std::pow(decay_[i], static_cast<double>(steps));
    return left;
  }
  /// The variance that each state gains in them, given what is left of it.
  std::array<double, N> drives(std::size_t steps, const std::array<double, N>& left) const {
    std::array<double, N> gained = drive_;
    gained[0] = drive_[0] * static_cast<double>(steps);
    for (int i = 1; i < states() && steps != 1; ++i)
      gained[i] = first_variance[i] * (1.0 - left[i] * left[i]);
    return gained;
  }

  double white;
  std::array<double, N> first_variance{};

 private:
  int states_;
  std::array<double, N> decay_{}, drive_{};
};

/// The covariance recursion, the same for every series that is filtered. What a value changes is
/// taken with the step after it, in one pass over the covariance.
template <int N>
class SlowRecursion {
 public:
  explicit SlowRecursion(const SlowLaw& law) : motion_(law), turning_(law.turning) {
    for (int i = 0; i < states(); ++i) at(i, i) = row_[i] = motion_.first_variance[i];
    shown_.fill(1.0);
    if (turns()) show();
  }

  int states() const { return motion_.states(); }
  const SlowMotion<N>& motion() const { return motion_; }
  const std::array<double, N>& gain() const { return gain_; }
  bool turns() const { return !turning_.empty(); }
  /// How much of each state a value shows: all, but of those that turn.
  const std::array<double, N>& shown() const { return shown_; }
  /// Variance of the innovation.
  double variance() const { return innovation_; }
  double log_variance() const { return log_innovation_; }

  void predict(std::size_t steps) {
    if (settled_ && steps == 1) return;
    settled_ = false;
    if (steps != steps_) prepare(steps);
    std::array<double, N> row{};
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j < states(); ++j) {
        double& both = at(i, j);
        both = (both - gain_[i] * row_[j]) * left_of_both_[i * N + j];
        if (i == j) both += gained_[i];
        row[i] += both;
      }
    row_ = row;
    position_ += steps;
    if (turns()) show();
    one_step_ = steps == 1;
  }
  /// The level gains a variance besides.
  void jump(double variance) {
    at(0, 0) += variance;
    row_[0] += variance;
    settled_ = one_step_ = false;
  }
  void update() {
    if (settled_) return;
    double innovation = motion_.white;
    for (int i = 0; i < states(); ++i) innovation += shown_[i] * row_[i];
    // Settled once nothing moves any more: the gains of a long even stretch are constant.
    double moved = std::abs(innovation - innovation_) / innovation;
    for (int i = 0; i < states(); ++i) {
      const double gain = row_[i] / innovation;
      moved = std::max(moved, std::abs(gain - gain_[i]));
      gain_[i] = gain;
    }
    innovation_ = innovation;
    log_innovation_ = std::log(innovation);
    settled_ = one_step_ && !turns() && moved < 1e-9;
  }

 private:
  double& at(int i, int j) { return covariance_[i * N + j]; }

  /// What a value shows of each state where the axes have turned to, and how it goes with them.
  void show() {
    const auto first = static_cast<std::size_t>(states()) - 2 * turning_.size();
    for (std::size_t t = 0; t < turning_.size(); ++t) {
      const double turned = turning_[t].angle * static_cast<double>(position_);
      shown_[first + 2 * t] = std::cos(turned);
      shown_[first + 2 * t + 1] = std::sin(turned);
    }
    for (int i = 0; i < states(); ++i) {
      row_[i] = 0.0;
      for (int j = 0; j < states(); ++j) row_[i] += at(i, j) * shown_[j];
    }
  }

  void prepare(std::size_t steps) {
    const auto left = motion_.decays(steps);
    gained_ = motion_.drives(steps, left);
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j < states(); ++j) left_of_both_[i * N + j] = left[i] * left[j];
    steps_ = steps;
  }

  SlowMotion<N> motion_;
  std::vector<SlowLaw::Turning> turning_;
  /// With which each state is in a value, and by how much a value moves it.
  std::array<double, N> row_{}, gain_{}, gained_{}, shown_{};
  std::array<double, N * N> covariance_{}, left_of_both_{};
  double innovation_ = 0.0, log_innovation_ = 0.0;
  std::size_t steps_ = 0, position_ = 0;
  bool one_step_ = false, settled_ = false;
};

/// The state of one filtered series.
template <int N>
struct SlowEstimate {
  std::array<double, N> state{};

  void predict(const std::array<double, N>& left, int states) {
    for (int i = 1; i < states; ++i) state[i] *= left[i];
  }
  double expected(const SlowRecursion<N>& r) const {
    double sum = 0.0;
    if (r.turns()) {
      for (int i = 0; i < r.states(); ++i) sum += r.shown()[i] * state[i];
      return sum;
    }
    for (int i = 0; i < r.states(); ++i) sum += state[i];
    return sum;
  }
  void update(const SlowRecursion<N>& r, double innovation) {
    for (int i = 0; i < r.states(); ++i) state[i] += r.gain()[i] * innovation;
  }
};

}  // namespace gyrostat::gap
