#pragma once

#include <cmath>
#include <utility>

#include <boost/math/distributions/students_t.hpp>

namespace gyrostat {

/// Confidence interval of a mean of n > 1 skewed values from their moments: Hall's monotone cubic
/// transformation of the t statistic (Hall, JRSS B 54, 1992, eq. 2.2), which takes out the
/// first-order effect of `skewness`. Student's own where there is none, otherwise not symmetric
/// about the mean. NaN without spread.
inline std::pair<double, double> skewed_mean_interval(double mean, double std, double skewness,
                                                      double n, double confidence) {
  const double z = boost::math::quantile(
      boost::math::complement(boost::math::students_t(n - 1.0), 0.5 - 0.5 * confidence));
  const double a = skewness / (3.0 * std::sqrt(n)), shift = skewness / (6.0 * std::sqrt(n));
  // The inverse of t + a t^2 + a^2 t^3 / 3 + shift.
  const auto back = [&](double x) {
    if (std::abs(a) < 1e-9) return x - shift;
    return (std::cbrt(1.0 + 3.0 * a * (x - shift)) - 1.0) / a;
  };
  const double error = std / std::sqrt(n);
  return {mean - error * back(z), mean - error * back(-z)};
}

}  // namespace gyrostat
