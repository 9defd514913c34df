#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Mean over time of -log N(nu; 0, S): the logarithmic score of the one-step predictions (Good
/// 1952). A proper score that needs no truth: on a static recording, the filter with the smallest
/// foretells the gyro best, and no choice of gain can cheat it as it can the size of z - x_hat.
struct LogScore {
  static constexpr std::string_view title = "logarithmic score of the innovations, mean";
  static constexpr std::string_view unit = "nat";
  static constexpr Goal goal = Goal::small;
  static constexpr TableOf table{
      .place = 1,
      .title = "logarithmic score of the innovations (small: foretells the gyro well)",
      .difference = "logarithmic score of the innovations"};

  double operator()(const TrackErrors& errors) const { return errors.innovations.log_score; }
};

}  // namespace gyrostat::metrics
