#pragma once

#include <cmath>

#include "core/types.hpp"

namespace gyrostat {

/// Mean and spread of values that come by once (Welford, Technometrics 4, 1962); NaN is left out.
struct Running {
  double count = 0.0, mean = 0.0, squares = 0.0;

  void add(double value) {
    if (std::isnan(value)) return;
    const double step = value - mean;
    mean += step / ++count;
    squares += step * (value - mean);
  }

  /// Standard error of the mean; no value for fewer than two values.
  double error() const {
    return count < 2.0 ? no_value : std::sqrt(squares / (count - 1.0) / count);
  }
};

}  // namespace gyrostat
