#pragma once

#include <array>
#include <cstddef>

#include <gyrostat/core/track.hpp>

namespace gyrostat {

/// How a filter's innovations nu compare with the variances S that it states. For a consistent
/// filter z = nu / sqrt(S) is white and standard normal (Bar-Shalom, Li and Kirubarajan 2001,
/// sec. 5.4).
struct Innovations {
  static constexpr std::size_t lags = 10, bins = 10;

  std::size_t count = 0;        ///< samples that had one
  double nis = no_value;        ///< mean of z^2
  double log_score = no_value;  ///< mean of -log N(nu; 0, S), nats
  double lag_1 = no_value;      ///< autocorrelation about zero of successive z (eq. 5.4.2-9)
  double ljung_box =
      no_value;  ///< of lags 1 to 10, chi-squared with 10 degrees of freedom if white
  std::array<double, bins>
      pit{};  ///< shares of z in the tenths of the standard normal distribution
};

Innovations innovation_statistics(const Track& track);

}  // namespace gyrostat
