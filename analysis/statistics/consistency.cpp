#include <gyrostat/analysis/statistics/consistency.hpp>

#include <cmath>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/analysis/statistics/skewed_mean.hpp>

namespace gyrostat {

Acceptance mean_square_bounds(double degrees, double alpha) {
  if (!(degrees > 0.0)) return {};
  return {chi_squared_quantile(alpha / 2.0, degrees) / degrees,
          chi_squared_upper_quantile(alpha / 2.0, degrees) / degrees};
}

Acceptance chi_squared_bound(double degrees, double alpha) {
  if (!(degrees > 0.0)) return {};
  return {0.0, chi_squared_upper_quantile(alpha, degrees)};
}

Acceptance trial_mean_bounds(const Running& over_trials, double expected, double alpha) {
  if (!(over_trials.count > 1.0)) return {};
  const auto [below, above] = skewed_mean_reach(over_trials, alpha / 2.0);
  return {expected - above, expected + below};
}

Acceptance correlation_bounds(double count, double alpha) {
  if (!(count > 0.0)) return {};
  const double bound = normal_upper_quantile(alpha / 2.0) / std::sqrt(count);
  return {-bound, bound};
}

}  // namespace gyrostat
