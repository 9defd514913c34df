#pragma once

#include <span>
#include <vector>

#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// 1 for the least; ties share the mean of their ranks; NaN comes last.
std::vector<double> mid_ranks(std::span<const double> values);

/// The value that the range of `groups` >= 2 independent standard normal deviates exceeds with
/// probability 1 - confidence: the studentised range for infinitely many degrees of freedom.
double studentised_range_quantile(double confidence, std::size_t groups);

/// Ranks of methods, trial by trial (Friedman, JASA 32, 1937).
class RankStatistics {
 public:
  explicit RankStatistics(std::size_t methods) : sums_(methods) {}

  /// One value a method: a trial. Small is good.
  void add(std::span<const double> values);

  double mean_rank(std::size_t method) const;

  /// Mean ranks that differ by more are separable, all pairs at once, 95 % (Nemenyi 1963; Demsar,
  /// JMLR 7, 2006, sec. 3.2.2).
  double critical_difference() const;

  /// Probability of mean ranks so far apart where all methods are alike: Friedman's chi-squared
  /// with its correction for ties (Conover 1999, sec. 5.8).
  double friedman_p() const;

 private:
  std::size_t count_ = 0;
  double all_squares_ = 0.0;
  std::vector<double> sums_;
};

}  // namespace gyrostat
