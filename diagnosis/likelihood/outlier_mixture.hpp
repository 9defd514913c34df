#pragma once

#include <vector>

namespace gyrostat::gap {

/// Squares of two normal components, of which the wide one may be about a size, up or down.
struct OutlierMixture {
  double share, narrow, wide;  ///< probability of the wide one; variances
  double size = 0.0;           ///< about which the wide one is, up or down
  double gain = 0.0;           ///< log-likelihood beyond a single one's

  double log_odds(double square) const;
  bool is_wide(double square) const { return log_odds(square) > 0.0; }
};

/// By expectation-maximisation (Dempster, Laird and Rubin, J. Roy. Stat. Soc. B 39, 1977), from a
/// variance of the narrow one. About a size where that gains more than it costs.
OutlierMixture outlier_mixture(const std::vector<double>& squares, double narrow);

}  // namespace gyrostat::gap
