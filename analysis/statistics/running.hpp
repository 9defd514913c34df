#pragma once

#include <cmath>

#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// Mean, spread and skewness of values that come by once (Welford, Technometrics 4, 1962; Pebay,
/// Sandia report SAND2008-6212, eq. 2.2); NaN is left out. Sums of squares and cubes are about the
/// mean.
struct Running {
  double count = 0.0, mean = 0.0, squares = 0.0, cubes = 0.0;

  void add(double value) {
    if (std::isnan(value)) return;
    const double step = value - mean, shift = step / ++count;
    cubes += shift * (step * shift * (count - 1.0) * (count - 2.0) - 3.0 * squares);
    mean += shift;
    squares += step * (value - mean);
  }

  /// Standard error of the mean; no value for fewer than two values.
  double error() const {
    return count < 2.0 ? no_value : std::sqrt(squares / (count - 1.0) / count);
  }

  /// Of the values; no value for fewer than two.
  double std() const { return count < 2.0 ? no_value : std::sqrt(squares / (count - 1.0)); }

  /// 0 without spread; where powers overflow, the most that so many values can have.
  double skewness() const {
    if (!(squares > 0.0)) return 0.0;
    const double skewness = std::sqrt(count) * cubes / std::pow(squares, 1.5);
    return std::isfinite(skewness) ? skewness : std::copysign(std::sqrt(count), cubes);
  }
};

}  // namespace gyrostat
