#pragma once

#include <vector>

namespace gyrostat::gap {

/// Squares of a narrow normal component and of one to five wide ones.
struct OutlierMixture {
  struct Wide {
    double share, variance;
    double size = 0.0;  ///< about which it is, up or down
  };

  double narrow;  ///< its variance
  std::vector<Wide> wide;
  double gain = 0.0;  ///< log-likelihood beyond a single one's, less the cost of further values

  double share() const;  ///< of the wide ones
  double log_odds(double square) const;
  bool is_wide(double square) const { return log_odds(square) > 0.0; }
};

/// By expectation-maximisation (Dempster, Laird and Rubin, J. Roy. Stat. Soc. B 39, 1977), from a
/// variance of the narrow one. About a size, or with further wide ones, where that gains more than
/// it costs.
OutlierMixture outlier_mixture(const std::vector<double>& squares, double narrow);

}  // namespace gyrostat::gap
