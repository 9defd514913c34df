#pragma once

#include <vector>

namespace gyrostat::gap {

/// Of values each of which is exponential, about one of two means.
struct TwoExponentials {
  double share_on = 0.0, on = 0.0, off = 0.0;

  double log_likelihood(const std::vector<double>& values) const;
};

/// From a start, by expectation-maximisation (Dempster, Laird and Rubin, J. R. Stat. Soc. B 39,
/// 1977), with at most the given share on.
TwoExponentials two_exponentials(const std::vector<double>& values, TwoExponentials start,
                                 double most_on, int passes);

}  // namespace gyrostat::gap
