#pragma once

#include <cmath>
#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Estimate of phi at the end minus its initial value; no value for filters that do not carry it.
struct PhiChange {
  static constexpr std::string_view title = "how far phi moved";
  static constexpr std::string_view unit = "1";
  static constexpr Goal goal = Goal::none;

  double operator()(const TrackErrors& errors) const {
    return errors.learned_last.phi - errors.learned_first.phi;
  }
};

}  // namespace gyrostat::metrics
