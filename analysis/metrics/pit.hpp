#pragma once

#include <string_view>

#include <gyrostat/analysis/errors.hpp>
#include <gyrostat/analysis/goal.hpp>

namespace gyrostat::metrics {

/// Shares of innovations in the tenths of the normal distribution that the filter foretold
/// (probability integral transform; Dawid, JRSS A 147, 1984): pit_0 between its quantiles 0 and
/// 0.1, and so on; each is 0.1 for a consistent filter.
struct Pit {
  static constexpr std::size_t members = gyrostat::Innovations::bins;
  static constexpr std::string_view title = "innovations in tenth {} of what was foretold";
  static constexpr std::string_view unit = "1";
  static constexpr Goal goal = Goal::consistent;

  double operator()(const TrackErrors& errors, std::size_t tenth) const {
    return errors.innovations.pit[tenth];
  }
};

}  // namespace gyrostat::metrics
