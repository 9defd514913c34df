#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/evidence.hpp>

namespace gyrostat::gap {

/// The largest reference rate, dps.
inline double fastest_dps(const Conditions& conditions) {
  double fastest = 0.0;
  for (const double rate : conditions.series().rate_ref_dps)
    fastest = std::max(fastest, std::abs(rate));
  return fastest;
}

/// Whether the reference rate changes in one sample of fifty or fewer (as a participation ratio),
/// as that of a rate table does: what is off in so few is late, and hardly told from what it is
/// else.
inline bool turns_by_steps(const Conditions& conditions) {
  constexpr double fewest = 0.02;
  const auto& rate = conditions.series().rate_ref_dps;
  double squares = 0.0, fourths = 0.0;
  for (std::size_t i = 1; i < rate.size(); ++i) {
    const double square = (rate[i] - rate[i - 1]) * (rate[i] - rate[i - 1]);
    if (is_missing(square)) continue;
    squares += square;
    fourths += square * square;
  }
  return squares * squares < fewest * static_cast<double>(rate.size()) * fourths;
}

}  // namespace gyrostat::gap
