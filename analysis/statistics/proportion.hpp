#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include <gyrostat/analysis/statistics/distributions.hpp>

namespace gyrostat {

/// Confidence interval of a probability after `hits` of `count` > 0 trials (Wilson, JASA 22, 1927).
/// It reaches 0 where there were none, and 1 where there were no others, to the bit.
inline std::pair<double, double> wilson_interval(double hits, double count, double confidence) {
  const double z = normal_quantile(0.5 + 0.5 * confidence);
  const double p = hits / count;
  const double centre = (p + z * z / (2.0 * count)) / (1.0 + z * z / count);
  const double half =
      z / (1.0 + z * z / count) * std::sqrt(p * (1.0 - p) / count + z * z / (4.0 * count * count));
  return {hits == 0.0 ? 0.0 : std::max(0.0, centre - half),
          hits == count ? 1.0 : std::min(1.0, centre + half)};
}

}  // namespace gyrostat
