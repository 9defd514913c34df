#pragma once

#include <vector>

#include <gyrostat/core/series.hpp>

namespace gyrostat {

/// A heading without wraps, from 0 at its first value; missing where it is.
std::vector<double> unwrapped(const std::vector<double>& heading_deg);

/// Second by second, what a heading turns and what a rate turns, in degrees.
struct TurnsTogether {
  double count = 0.0, heading_squares = 0.0, rate_squares = 0.0, products = 0.0;

  double slope() const { return products / heading_squares; }
  double correlation() const;
};

/// Of the recording's times; `turned_deg` is its heading unwrapped(), of which the last value holds
/// where one is missing.
TurnsTogether turns_together(const Series& recording, const std::vector<double>& turned_deg,
                             const std::vector<double>& rate_dps);

}  // namespace gyrostat
