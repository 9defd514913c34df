#pragma once

#include <cmath>

#include "core/types.hpp"
#include "core/fields.hpp"
#include "core/random.hpp"
#include "core/series.hpp"
#include "generators/stage.hpp"

namespace gyrostat::effects {

/// The compass trails the true heading with one time constant; its noise is added afterwards.
struct CompassLag {
  double time_constant_s = 0.5;

  static constexpr std::string_view title = "the compass trails the heading";
  static constexpr Stage stage = Stage::compass;

  static constexpr auto fields() {
    using P = CompassLag;
    return std::array{
        Field{"time_constant_s", &P::time_constant_s, "s", ranges::non_negative,
              "time constant of the lag"},
    };
  }

  static constexpr CompassLag absent() { return {.time_constant_s = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    if (time_constant_s == 0.0) return;
    double behind_deg = 0.0;
    for (std::size_t i = 1; i < series.heading_deg.size(); ++i) {
      const double interval_s = series.t_s[i] - series.t_s[i - 1];
      behind_deg += (behind_deg + series.rate_ref_dps[i] * time_constant_s) *
                    std::expm1(-interval_s / time_constant_s);
      series.heading_deg[i] = wrap_degrees(series.heading_deg[i] + behind_deg);
    }
  }
};

}  // namespace gyrostat::effects
