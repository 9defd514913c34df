#pragma once

#include <vector>

#include <gyrostat/diagnosis/likelihood/marks.hpp>

namespace gyrostat::gap {

/// Pairs of samples between which the reference moves by more than rounding and noise could undo,
/// how many of them do not move as far, and how many are equal, or would be by chance: outliers
/// fall on the value before as they do on those on either side of it, where a filter that follows
/// the motion falls on one side alone.
struct KeptApart {
  double pairs = 0.0, still = 0.0, equal = 0.0, by_chance = 0.0;
  double in_a_row = 0.0, both_equal = 0.0;  ///< equal ones behind another such pair; that is equal
  double far_dps = 0.0;                     ///< what neither undoes
  double spread_dps = 0.0, grid_dps = 0.0;
  /// From which step of the reference on equal neighbours may well be repeated, as this share of
  /// samples is: at odds of a tenth against being rounded to the same value of a grid. What is
  /// hidden in vain is little noise the less, what is not is an outlier the more.
  double told_from_dps(double repeated) const;
  /// Where the gyro only lags, they stand still without being equal, but for as many as a coarse
  /// grid makes equal by chance.
  bool shows_repeats() const {
    // One is enough where nearly all others go with the motion: no lag holds back one of many.
    constexpr double enough_pairs = 50.0, most_still = 0.1, nearly_all = 0.95;
    const bool others_follow = pairs >= enough_pairs && still <= most_still * pairs;
    return equal >= (others_follow ? 1.0 : 2.0) && equal >= nearly_all * still;
  }
};

/// Of both parts, since a repeat is certain where it shows, and may show but a few times; beside
/// the marks of grid and limits. No pairs without a reference.
KeptApart kept_apart_by_motion(const Conditions& conditions, const std::vector<double>& gyro_dps,
                               const Marks& marks, double resolution_dps);

}  // namespace gyrostat::gap
