#pragma once

#include <span>
#include <vector>

#include <gyrostat/analysis/statistics/paired.hpp>

namespace gyrostat {

/// The paired differences of all pairs of methods, of values that come by trial by trial: two
/// passes. Their 95 % intervals hold together, each as wide, in standard errors, as the largest of
/// all |t| where nothing differs ("single-step max-t": Hothorn, Bretz and Westfall, Biometrical
/// Journal 50, 2008, sec. 3). That is narrower than Bonferroni's, for differences from one method
/// err together. The distribution is that of 20,000 draws with the correlations of the trials,
/// always the same draws, so the level is met within a standard error of 0.15 %.
///
/// Example: three methods, trial by trial.
///
///   const std::vector<std::vector<double>> trials = {{0.21, 0.24, 0.31}, {0.34, 0.36, 0.41}};
///   AllPairs pairs(3);
///   do {
///     for (const auto& values : trials) pairs.add(values);
///   } while (pairs.another_pass());
///   const PairedDifference difference = pairs.difference(0, 1);
///
/// Thread safety: `add` and `another_pass` belong to one thread; then any number may ask.
class AllPairs {
 public:
  /// `looks`: by how many looks at the results the level is shared.
  explicit AllPairs(std::size_t methods, double looks = 1.0);

  /// The values of a trial, one a method, NaN where there is none.
  void add(std::span<const double> values);
  /// Ends a pass; whether another one over the same values, in the same order, is needed.
  bool another_pass();

  /// a minus b; with no value before the last pass has ended.
  PairedDifference difference(std::size_t a, std::size_t b) const;
  /// As many independent comparisons would need intervals as wide.
  double comparisons() const { return comparisons_; }

 private:
  struct Pair {
    std::size_t count = 0;
    double sum = 0.0, mean = 0.0, squares = 0.0, cubes = 0.0;
    Running differences() const { return {static_cast<double>(count), mean, squares, cubes}; }
    double error() const { return differences().error(); }
  };
  const Pair& pair(std::size_t a, std::size_t b) const { return pairs_[a * (a - 1) / 2 + b]; }
  double widest_error() const;
  /// The largest |t| of each draw, of pairs that are not all but the same; these count one by one.
  std::vector<double> largest() const;

  std::size_t methods_;
  double looks_, comparisons_;
  int passes_ = 0;
  std::vector<Pair> pairs_;  ///< of a > b, by a
};

}  // namespace gyrostat
