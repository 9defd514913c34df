#pragma once

#include <cmath>
#include <utility>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/analysis/statistics/running.hpp>

namespace gyrostat {

/// What brings the t statistic of a mean of n > 1 skewed values to Student's: a monotone cubic that
/// takes out the first-order effect of their skewness (Hall, JRSS B 54, 1992, eq. 2.2).
class HallTransformation {
 public:
  HallTransformation(double skewness, double n)
      : a_(skewness / (3.0 * std::sqrt(n))), shift_(0.5 * a_) {}

  double student(double t) const { return t + a_ * t * t + a_ * a_ * t * t * t / 3.0 + shift_; }
  /// Its inverse.
  double statistic(double student) const {
    const double s = student - shift_;
    return std::abs(a_) < 1e-9 ? s : (std::cbrt(1.0 + 3.0 * a_ * s) - 1.0) / a_;
  }

 private:
  double a_, shift_;
};

/// How far below and above the mean of n > 1 values its interval by Hall's transformation ends; the
/// truth lies beyond each end with probability `tail`. Student's own where values are not skewed.
inline std::pair<double, double> skewed_mean_reach(const Running& values, double tail) {
  const double z = student_t_upper_quantile(tail, values.count - 1.0);
  const HallTransformation hall(values.skewness(), values.count);
  return {values.error() * hall.statistic(z), -values.error() * hall.statistic(-z)};
}

/// The ends.
inline std::pair<double, double> skewed_mean_interval(const Running& values, double tail) {
  const auto [below, above] = skewed_mean_reach(values, tail);
  return {values.mean - below, values.mean + above};
}

/// Probability of a mean that far from 0 were it 0, two-sided: twice the `tail` of the interval
/// that ends at 0.
inline double skewed_mean_p(const Running& values) {
  const HallTransformation hall(values.skewness(), values.count);
  const double student = hall.student(values.mean / values.error());
  return 2.0 * student_t_upper_tail(std::abs(student), values.count - 1.0);
}

}  // namespace gyrostat
