#include "analysis/statistics/paired.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace gyrostat {

PairedDifference paired_difference(std::span<const double> a, std::span<const double> b,
                                   std::size_t family) {
  std::size_t count = 0;
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = a[i] - b[i];
    if (std::isnan(d)) continue;
    sum += d;
    ++count;
  }
  const double mean = sum / static_cast<double>(count);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = a[i] - b[i] - mean;
    if (!std::isnan(d)) squares += d * d;
  }
  return paired_difference(count, mean, squares, static_cast<double>(family));
}

PairedDifference paired_difference(std::size_t count, double mean, double squares, double family) {
  PairedDifference result;
  result.count = count;
  if (count < 2) return result;
  const double n = static_cast<double>(count);
  result.mean = mean;
  const double std = std::sqrt(squares / (n - 1.0));
  const double error = std / std::sqrt(n);

  const double comparisons = std::max(family, 1.0);
  const boost::math::students_t t(n - 1.0);
  const double tail = 0.025 / comparisons;
  result.half_width = boost::math::quantile(boost::math::complement(t, tail)) * error;
  result.separable = std::abs(result.mean) > result.half_width;
  result.p_adjusted = error > 0.0 ? std::min(1.0, 2.0 * comparisons *
                                                      boost::math::cdf(boost::math::complement(
                                                          t, std::abs(result.mean) / error)))
                                  : (result.mean == 0.0 ? 1.0 : 0.0);
  const boost::math::normal normal;
  const double reach = boost::math::quantile(boost::math::complement(normal, tail)) +
                       boost::math::quantile(normal, 0.8);
  if (result.mean != 0.0) {
    const double ratio = reach * std / result.mean;
    result.trials_needed = std::max(2.0, std::ceil(ratio * ratio));
  }
  return result;
}

}  // namespace gyrostat
