#include <gyrostat/analysis/statistics/consistency.hpp>

#include <cmath>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>

#include <gyrostat/analysis/statistics/skewed_mean.hpp>

namespace gyrostat {

using boost::math::complement;
using boost::math::quantile;

Acceptance mean_square_bounds(double degrees, double alpha) {
  if (!(degrees > 0.0)) return {};
  const boost::math::chi_squared chi(degrees);
  return {quantile(chi, alpha / 2.0) / degrees, quantile(complement(chi, alpha / 2.0)) / degrees};
}

Acceptance chi_squared_bound(double degrees, double alpha) {
  if (!(degrees > 0.0)) return {};
  return {0.0, quantile(complement(boost::math::chi_squared(degrees), alpha))};
}

Acceptance trial_mean_bounds(const Running& over_trials, double expected, double alpha) {
  if (!(over_trials.count > 1.0)) return {};
  const auto [below, above] = skewed_mean_reach(over_trials, alpha / 2.0);
  return {expected - above, expected + below};
}

Acceptance correlation_bounds(double count, double alpha) {
  if (!(count > 0.0)) return {};
  const double bound = quantile(complement(boost::math::normal(), alpha / 2.0)) / std::sqrt(count);
  return {-bound, bound};
}

}  // namespace gyrostat
