#pragma once

#include <vector>

namespace gyrostat::gap {

/// Normal noise whose size follows a temperature: 1 + slope (T - T0) + curvature (T - T0)^2 times
/// the deviation.
struct NoiseOver {
  double deviation;
  double slope = 0.0, curvature = 0.0;
  double gain = 0.0;  ///< log-likelihood beyond noise of one size, were all as normal

  double gain_at(double off_C) const;
};

/// By Fisher scoring of the logarithm of the size, over innovations that are not beyond `cut`
/// deviations; with a curvature where that gains clearly more than its value would by chance.
/// `off_C` is T - T0 of each, `deviation` a first one.
NoiseOver noise_over(const std::vector<double>& off_C, const std::vector<double>& innovations,
                     double deviation, double cut);

}  // namespace gyrostat::gap
