#pragma once

#include <string_view>

#include "analysis/errors.hpp"

namespace gyrostat::metrics {

/// Share of innovations between the quantiles 0.1 and 0.2 of the normal distribution that the
/// filter foretold (probability integral transform; Dawid, JRSS A 147, 1984): 0.1 for a consistent
/// filter.
struct Pit1 {
  static constexpr std::string_view title = "innovations in tenth 2 of what was foretold";
  static constexpr std::string_view unit = "1";

  double operator()(const TrackErrors& errors) const { return errors.innovations.pit[1]; }
};

}  // namespace gyrostat::metrics
