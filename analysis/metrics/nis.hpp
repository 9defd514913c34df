#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Mean over time of nu^2 / S (Bar-Shalom et al. 2001, sec. 5.4.2): 1 for a consistent filter.
struct Nis {
  static constexpr std::string_view title = "normalised innovation squared, mean";
  static constexpr std::string_view unit = "1";
  static constexpr Goal goal = Goal::consistent;

  double operator()(const TrackErrors& errors) const { return errors.innovations.nis; }
};

}  // namespace gyrostat::metrics
