#include <gyrostat/diagnosis/significance.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/thresholds.hpp>

namespace gyrostat::gap {

double p_of_the_clearest(double p_of_lenses, double p_of_the_unexplained, double log_odds) {
  using namespace thresholds;
  const double p_of_odds = log_odds > 0.0 ? chance_of_a_find * std::exp(-log_odds) : 1.0;
  const double clearest =
      std::min({p_of_lenses / weight_of_lenses, p_of_the_unexplained / weight_of_unexplained,
                p_of_odds / weight_of_odds});
  const double by_lenses = std::min(1.0, weight_of_lenses * clearest);
  const double by_odds = std::min(chance_of_a_find, weight_of_odds * clearest);
  return by_lenses + by_odds - by_lenses * by_odds;
}

}  // namespace gyrostat::gap
