#pragma once

#include <cstddef>
#include <vector>

#include <gyrostat/generators/continuous_low_pass.hpp>

namespace gyrostat {

/// White noise as samples show it that are taken after a filter of continuous time, which what is
/// above half their rate passes, too: an autoregressive moving average of white samples, with unit
/// gain at rest (Astrom, "Introduction to Stochastic Control Theory", 1970, 3.10: the poles are
/// those of the filter over an interval, the moving average is the factor of what they leave).
class SampledLowPass {
 public:
  /// Of 1 to 4 poles: beyond, the moving average is lost in rounding.
  explicit SampledLowPass(const LowPassSystem& filter);

  double operator()(double white);

  static constexpr std::size_t most_poles = 4;

 private:
  std::vector<double> a_, b_;  ///< from lag 1, and from lag 0 on
  std::vector<double> inputs_, outputs_;
};

/// |H|^2 of a system of second order at this square of the frequency over its natural one.
inline double second_order_gain(double square, double damping_ratio) {
  return 1.0 / ((1.0 - square) * (1.0 - square) + 4.0 * damping_ratio * damping_ratio * square);
}

/// |H|^2 of its density over that at rest: the filter's, folded at half the sampling rate.
class FoldedGain {
 public:
  FoldedGain(double cutoff_cycles, std::size_t poles, bool maximally_flat);
  static FoldedGain of_second_order(double cutoff_cycles, double damping_ratio);

  double operator()(double cycles) const { return sum_at(cycles) / at_rest_; }

 private:
  double sum_at(double cycles) const;

  double cutoff_cycles_;
  std::size_t poles_;
  bool maximally_flat_;
  double damping_ratio_ = 0.0;  ///< of a system of second order
  double further_ = 0.0, at_rest_ = 1.0;
};

}  // namespace gyrostat
