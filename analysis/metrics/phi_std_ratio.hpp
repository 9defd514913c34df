#pragma once

#include <cmath>
#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// What is left of the uncertainty of phi at the end: near 0, the filter has stopped learning it.
struct PhiStdRatio {
  static constexpr std::string_view title = "standard deviation of phi, last over first";
  static constexpr std::string_view unit = "1";
  static constexpr Goal goal = Goal::none;

  double operator()(const TrackErrors& errors) const {
    return errors.learned_last.phi_std / errors.learned_first.phi_std;
  }
};

}  // namespace gyrostat::metrics
