#pragma once

#include <cmath>
#include <cstddef>

#include <gyrostat/core/packed/exponential.hpp>
#include <gyrostat/core/packed/pack.hpp>
#include <gyrostat/diagnosis/likelihood/histories/jump_trail.hpp>
#include <gyrostat/diagnosis/likelihood/histories/kernels.hpp>

namespace gyrostat::gap {

/// Histories of jumps side by side: of each a lane, with its probability, the level (of two: +1 or
/// -1 times half their distance) and what it makes of up to N states. From value to value those on
/// a level have one child that jumps, and two that say nearly the same become one of their mean and
/// covariance: many unlikely histories say together what none of them says alone (Salmond, IEEE
/// Trans. AES-45, 2009).
template <class Target, int N>
class JumpHistories {
 public:
  static constexpr int most_kept = 6;
  /// Two levels have a child each.
  static constexpr int lanes = most_kept + 2;
  using Lanes = Pack<Target, lanes>;
  using Trail = JumpTrail<Target, lanes>;

  /// Writes down in `trail`, where there is one, which of two levels each value is on (-1 or 1), or
  /// else where the level jumps (0 or 1).
  JumpHistories(const JumpLaw& law, Trail* trail)
      : law_(law), trail_(trail), size_(law.is_of_two ? 2 : 1) {
    for (int h = 0; h < size_; ++h) {
      set(weight_, h, 1.0 / size_);
      if (law.is_of_two) set(level_, h, h == 0 ? -law.jump_dps : law.jump_dps);
    }
    for (int i = 0; i < states(); ++i) {
      state_[i] = Lanes(0.0);
      for (int j = 0; j <= i; ++j) at(i, j) = Lanes(i == j ? law.first_variance[i] : 0.0);
    }
    if (trail_ != nullptr) write_down(size_, false);
  }

  void predict(std::size_t steps) {
    if (steps != steps_) prepare(steps);
    for (int i = 0; i < states(); ++i) state_[i] *= Lanes(left_[i]);
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j <= i; ++j) {
        at(i, j) *= Lanes(left_[i] * left_[j]);
        if (i == j) at(i, j) += Lanes(gained_[i]);
      }
    const int parents = size_;
    if (law_.is_of_two) {
      bear(parents, -law_.jump_dps);
      bear(parents, law_.jump_dps);
    } else {
      bear(parents, 0.0);
    }
    weight_ = select(index_ < Lanes(parents), Lanes(weight_ * Lanes(1.0 - jump_)), weight_);
    if (trail_ != nullptr) write_down(parents, true);
  }

  /// Takes a value in, and returns the logarithm of its density.
  double update(double value) {
    find_expectations();
    const Lanes information = Lanes(1.0) / variance_,
                innovation = Lanes(value) - level_ - expected_;
    for (int i = 0; i < states(); ++i) {
      const Lanes gain = row_[i] * information;
      state_[i] += gain * innovation;
      for (int j = 0; j <= i; ++j) at(i, j) -= gain * row_[j];
    }
    const auto is_there = index_ < Lanes(size_) && weight_ > Lanes(0.0);
    const Lanes misfit =
        select(is_there, Lanes(Lanes(0.5) * innovation * innovation * information), Lanes(1e300));
    const double least = least_of(misfit);
    const Lanes before = select(weight_ < Lanes(least_weight), Lanes(least_weight), weight_);
    weight_ = select(is_there,
                     Lanes(before * (sqrt(information) * exp_of_negative(Lanes(least) - misfit))),
                     Lanes(0.0));
    const double total = sum(weight_);
    weight_ *= Lanes(1.0 / total);
    return std::log(total) - least - 0.91893853320467274178;  // log(2 pi) / 2
  }

  /// Leaves most_kept of them.
  void reduce() {
    if (size_ <= most_kept) return;
    find_expectations();
    while (size_ > most_kept) {
      const auto [one, other] = most_alike();
      join(other, one);
      if (--size_ != other) copy(size_, other);
    }
  }

  /// Writes down what is old enough to be known, or, at the end, all.
  void settle(bool at_the_end) {
    if (trail_ == nullptr) return;
    alignas(64) double weights[lanes];
    select(index_ < Lanes(size_), weight_, Lanes(0.0)).store(weights);
    trail_->settle(weights, at_the_end);
  }

 private:
  static constexpr double least_weight = 1e-290;  ///< below which there may be no reciprocal
  static constexpr double indices[lanes] = {0, 1, 2, 3, 4, 5, 6, 7};
  struct Pair {
    int one, other;
  };

  int states() const { return N <= 3 ? N : law_.states; }
  /// Of states j <= i.
  Lanes& at(int i, int j) { return covariance_[i * (i + 1) / 2 + j]; }
  void set(Lanes& of, int lane, double value) {
    of = select(index_ == Lanes(lane), Lanes(value), of);
  }
  static double sum(const Lanes& of) {
    return ((of[0] + of[4]) + (of[2] + of[6])) + ((of[1] + of[5]) + (of[3] + of[7]));
  }

  static double least_of(const Lanes& of) {
    const auto less = [](double a, double b) { return a < b ? a : b; };
    return less(less(less(of[0], of[4]), less(of[2], of[6])),
                less(less(of[1], of[5]), less(of[3], of[7])));
  }

  void prepare(std::size_t steps) {
    const auto count = static_cast<double>(steps);
    const double mean = law_.jumps_per_s * law_.interval_s * count;
    jump_ = law_.is_of_two ? 0.5 * -std::expm1(-2.0 * mean) : -std::expm1(-mean);
    for (int i = 0; i < states(); ++i) {
      left_[i] = steps == 1 ? law_.decay[i] : std::pow(law_.decay[i], count);
      gained_[i] = steps == 1 ? law_.drive[i]
                   : i == 0   ? law_.drive[i] * count
                              : law_.first_variance[i] * (1.0 - left_[i] * left_[i]);
    }
    steps_ = steps;
  }

  /// What each expects of the next value but for its level, how surely, and how it goes with the
  /// states.
  void find_expectations() {
    for (int i = 0; i < states(); ++i) row_[i] = at(i, i);
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j < i; ++j) {
        row_[i] += at(i, j);
        row_[j] += at(i, j);
      }
    expected_ = state_[0];
    variance_ = Lanes(law_.white) + row_[0];
    for (int i = 1; i < states(); ++i) {
      expected_ += state_[i];
      variance_ += row_[i];
    }
  }

  /// The two whose becoming one loses least: their divergence (Jeffreys 1946) times what both
  /// weigh.
  Pair most_alike() const {
    const Lanes information = Lanes(1.0) / variance_;
    alignas(64) double expected[lanes], variance[lanes], informed[lanes], weight[lanes],
        level[lanes], least_loss[lanes], others[lanes];
    expected_.store(expected);
    variance_.store(variance);
    information.store(informed);
    weight_.store(weight);
    level_.store(level);
    Lanes least(1e300), other(0.0);
    for (int h = 1; h < size_; ++h) {
      const Lanes apart = expected_ - Lanes(expected[h]), wider = variance_ - Lanes(variance[h]);
      const Lanes divergence = (apart * apart * (variance_ + Lanes(variance[h])) + wider * wider) *
                               (information * Lanes(informed[h]));
      const Lanes both = weight_ + Lanes(weight[h]);
      const Lanes loss = divergence * (weight_ * Lanes(weight[h])) / (both + Lanes(1e-300));
      const auto is_less = index_ < Lanes(h) && level_ == Lanes(level[h]) && loss < least;
      least = select(is_less, loss, least);
      other = select(is_less, Lanes(h), other);
    }
    least.store(least_loss);
    other.store(others);
    int one = 0;
    for (int g = 1; g < lanes; ++g)
      if (least_loss[g] < least_loss[one]) one = g;
    return {one, static_cast<int>(others[one])};
  }

  /// The child of those of the parents that are on a level, of their mean and covariance.
  void bear(int parents, double level) {
    const Lanes weights =
        select(index_ < Lanes(parents) && level_ == Lanes(level), weight_, Lanes(0.0));
    const double total = sum(weights);
    if (!(total >= least_weight)) return;
    const Lanes share = weights * Lanes(1.0 / total);
    const int child = size_++;
    // About the first of them, so that no sum waits for another.
    Lanes apart[N];
    double mean[N];
    for (int i = 0; i < states(); ++i) {
      apart[i] = state_[i] - Lanes(state_[i][0]);
      mean[i] = sum(share * apart[i]);
    }
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j <= i; ++j) {
        double both = sum(share * (at(i, j) + apart[i] * apart[j])) - mean[i] * mean[j];
        if (i == 0 && !law_.is_of_two) both += law_.jump_dps * law_.jump_dps;
        set(at(i, j), child, both);
      }
    for (int i = 0; i < states(); ++i) set(state_[i], child, state_[i][0] + mean[i]);
    if (trail_ != nullptr) {
      alignas(64) double shares[lanes];
      share.store(shares);
      trail_->bear(shares, child);
    }
    set(weight_, child, total * jump_);
    set(level_, child, -level);
  }

  /// Of two levels, the one that each is on; else, which have jumped: those born after `parents`.
  void write_down(int parents, bool may_have_jumped) {
    alignas(64) double said[lanes];
    const Lanes jumped =
        select(index_ < Lanes(parents) || !may_have_jumped, Lanes(0.0), Lanes(1.0));
    (law_.is_of_two ? select(level_ < Lanes(0.0), Lanes(-1.0), Lanes(1.0)) : jumped).store(said);
    trail_->step(said);
  }

  /// `into` becomes both of them, of their mean and covariance.
  void join(int from, int into) {
    const double both = weight_[from] + weight_[into];
    if (both == 0.0) return;
    const double share = weight_[from] / both;
    double apart[N];
    for (int i = 0; i < states(); ++i) {
      apart[i] = state_[i][from] - state_[i][into];
      set(state_[i], into, state_[i][into] + share * apart[i]);
    }
    for (int i = 0; i < states(); ++i)
      for (int j = 0; j <= i; ++j) {
        const double mine = at(i, j)[into];
        set(at(i, j), into,
            mine + share * (at(i, j)[from] - mine + (1.0 - share) * apart[i] * apart[j]));
      }
    for (Lanes* of : {&expected_, &variance_})
      set(*of, into, (*of)[into] + share * ((*of)[from] - (*of)[into]));
    set(weight_, into, both);
    if (trail_ != nullptr) trail_->join(from, into, share);
  }

  void copy(int from, int to) {
    const auto there = index_ == Lanes(to);
    const auto copy = [&](Lanes& of) { of = select(there, Lanes(of[from]), of); };
    for (Lanes* of : {&weight_, &level_, &expected_, &variance_}) copy(*of);
    for (int i = 0; i < states(); ++i) {
      copy(state_[i]);
      for (int j = 0; j <= i; ++j) copy(at(i, j));
    }
    if (trail_ != nullptr) trail_->copy(from, to);
  }

  const JumpLaw& law_;
  Trail* trail_;
  int size_;
  double jump_ = 0.0;
  std::size_t steps_ = 0;
  double left_[N] = {}, gained_[N] = {};
  Lanes index_ = Lanes::load(indices), weight_{0.0}, level_{0.0}, expected_{0.0}, variance_{0.0};
  Lanes state_[N], row_[N], covariance_[N * (N + 1) / 2];
};

}  // namespace gyrostat::gap
