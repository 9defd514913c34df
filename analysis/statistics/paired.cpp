#include <gyrostat/analysis/statistics/paired.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/analysis/statistics/skewed_mean.hpp>

namespace gyrostat {

PairedDifference paired_difference(std::span<const double> a, std::span<const double> b,
                                   std::size_t family) {
  Running differences;
  for (std::size_t i = 0; i < a.size(); ++i) differences.add(a[i] - b[i]);
  return paired_difference(differences, static_cast<double>(family));
}

PairedDifference paired_difference(const Running& differences, double family) {
  const double n = differences.count;
  PairedDifference result{.count = static_cast<std::size_t>(n)};
  if (n < 2.0) return result;
  result.mean = differences.mean;

  const double comparisons = std::max(family, 1.0), tail = 0.025 / comparisons;
  std::tie(result.low, result.high) = skewed_mean_interval(differences, tail);
  result.separable = result.low > 0.0 || result.high < 0.0;
  const double error = differences.error();
  result.p_adjusted = error > 0.0          ? std::min(1.0, comparisons * skewed_mean_p(differences))
                      : result.mean == 0.0 ? 1.0
                                           : 0.0;
  if (result.mean != 0.0) {
    const double errors = normal_upper_quantile(tail) + normal_quantile(0.8);
    const double ratio = errors * error * std::sqrt(n) / result.mean;
    result.trials_needed = std::max(2.0, std::ceil(ratio * ratio));
  }
  return result;
}

}  // namespace gyrostat
