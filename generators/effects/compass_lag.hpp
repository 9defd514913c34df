#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The compass trails the heading through a delay and equal poles, exactly so for a heading that is
/// linear between samples and along the shorter arc; its noise is added afterwards.
struct CompassLag {
  double time_constant_s = 0.5;
  double poles = 1.0;
  double delay_s = 0.0;

  static constexpr std::string_view title = "the compass trails the heading";
  static constexpr Stage stage = Stage::compass;
  static constexpr std::array needs = {&Series::heading_deg};

  static constexpr auto fields() {
    using P = CompassLag;
    return std::array{
        Field{"time_constant_s", &P::time_constant_s, "s", ranges::non_negative,
              "time constants of all poles, added"},
        Field{"poles", &P::poles, "1", Range{.from = 1, .to = 8, .whole = true}, "how many poles"},
        Field{"delay_s", &P::delay_s, "s", ranges::non_negative,
              "time that passes before; until then, the first heading"},
    };
  }

  static constexpr CompassLag absent() { return {.time_constant_s = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    if (delay_s > 0.0) delay(series);
    if (time_constant_s == 0.0) return;
    for (long k = std::lround(poles); k > 0; --k) pass(series);
  }

 private:
  void delay(Series& series) const {
    const auto heading_deg = series.heading_deg;
    for (std::size_t i = 0, from = 0, n = samples_with(series, needs); i < n; ++i) {
      const double then_s = series.t_s[i] - delay_s;
      while (from + 1 < i && series.t_s[from + 1] <= then_s) ++from;
      if (i == 0 || then_s <= series.t_s[0]) {
        series.heading_deg[i] = heading_deg[0];
        continue;
      }
      const double share = (then_s - series.t_s[from]) / (series.t_s[from + 1] - series.t_s[from]);
      series.heading_deg[i] =
          heading_deg[from] + share * wrap_degrees(heading_deg[from + 1] - heading_deg[from]);
    }
  }

  /// One pole.
  void pass(Series& series) const {
    const double tau_s = time_constant_s / std::round(poles);
    Decay decay(tau_s);
    double behind_deg = 0.0, before_deg = 0.0;
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double heading_deg = series.heading_deg[i];
      if (i > 0) {
        const double interval_s = series.t_s[i] - series.t_s[i - 1];
        const double rate_dps = wrap_degrees(heading_deg - before_deg) / interval_s;
        behind_deg -= (1.0 - decay.over(interval_s)) * (behind_deg + rate_dps * tau_s);
      }
      before_deg = heading_deg;
      series.heading_deg[i] += behind_deg;
    }
  }
};

}  // namespace gyrostat::effects
