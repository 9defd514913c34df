#pragma once

#include <cmath>

#include <gyrostat/core/fields.hpp>

namespace gyrostat::motion {

/// A rate table stepping through +rate, rest, -rate, rest, so that it ends each cycle where it
/// began.
struct RateTable {
  double rate_dps = 10.0;
  double period_s = 40.0;

  static constexpr std::string_view title = "rate table: +rate, rest, -rate, rest";

  static constexpr auto fields() {
    using P = RateTable;
    return std::array{
        Field{"rate_dps", &P::rate_dps, "dps", ranges::any, "rate of the turning quarters"},
        Field{"period_s", &P::period_s, "s", ranges::positive, "duration of one cycle"},
    };
  }

  double operator()(double t_s) const {
    const double phase = t_s / period_s - std::floor(t_s / period_s);
    if (phase < 0.25) return rate_dps;
    return phase >= 0.5 && phase < 0.75 ? -rate_dps : 0.0;
  }
};

}  // namespace gyrostat::motion
