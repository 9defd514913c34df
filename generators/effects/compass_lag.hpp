#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/generators/delayed_heading.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The compass trails the heading through a delay and equal poles, exactly so for a heading that is
/// linear between samples and along the shorter arc; its noise is added afterwards. What iron adds
/// trails with it, or not: a compass that filters readings delays both, one whose heading is
/// smoothed by a gyro shows iron at once. A magnetometer's filter passes the field's components, of
/// which a fast turn leaves less.
struct CompassLag {
  double time_constant_s = 0.5;
  double poles = 1.0;
  double delay_s = 0.0;
  double turns_alone = 0.0;
  double of_field = 0.0;

  static constexpr std::string_view title = "the compass trails the heading";
  static constexpr Stage stage = Stage::compass;
  static constexpr std::array needs = {&Series::heading_deg};

  static constexpr auto fields() {
    using P = CompassLag;
    return std::array{
        Field{"time_constant_s", &P::time_constant_s, "s", ranges::non_negative,
              "time constants of all poles, added"},
        Field{"poles", &P::poles, "1", Range{.from = 1, .to = 8, .whole = true}, "how many poles"},
        Field{"delay_s", &P::delay_s, "s", Range{.from = -0.1},
              "time that passes before; until then, the first heading. Below 0 where the heading's "
              "clock is early"},
        Field{"turns_alone", &P::turns_alone, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: only the vehicle's turns trail, and what iron adds does not"},
        Field{"of_field", &P::of_field, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: the field's components pass the poles; 0: its direction"},
    };
  }

  static constexpr CompassLag absent() { return {.time_constant_s = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    if (turns_alone < 0.5) {
      trail(series.t_s, series.heading_deg);
      return;
    }
    std::vector<double> turned(samples_with(series, std::array{&Series::rate_ref_dps}), 0.0);
    for (std::size_t i = 1; i < turned.size(); ++i)
      turned[i] = turned[i - 1] + series.rate_ref_dps[i] * (series.t_s[i] - series.t_s[i - 1]);
    auto trailing = turned;
    trail(series.t_s, trailing);
    for (std::size_t i = 0, n = std::min(turned.size(), series.heading_deg.size()); i < n; ++i)
      series.heading_deg[i] += trailing[i] - turned[i];
  }

 private:
  void trail(const std::vector<double>& t_s, std::vector<double>& heading_deg) const {
    const std::size_t n = std::min(t_s.size(), heading_deg.size());
    if (delay_s != 0.0)
      delay_heading(
          t_s, [&](std::size_t /*i*/) { return delay_s; }, heading_deg);
    if (time_constant_s == 0.0) return;
    if (of_field < 0.5) {
      pass(t_s, heading_deg, n);
      return;
    }
    constexpr double rad = std::numbers::pi / 180.0;
    std::vector<double> north(n), east(n);
    for (std::size_t i = 0; i < n; ++i) {
      north[i] = std::cos(heading_deg[i] * rad);
      east[i] = std::sin(heading_deg[i] * rad);
    }
    pass(t_s, north, n);
    pass(t_s, east, n);
    for (std::size_t i = 0; i < n; ++i) {
      const double direction_deg = std::atan2(east[i], north[i]) / rad;
      heading_deg[i] += wrap_degrees(direction_deg - heading_deg[i]);
    }
  }

  void pass(const std::vector<double>& t_s, std::vector<double>& values, std::size_t n) const {
    for (long k = std::lround(poles); k > 0; --k) pass_once(t_s, values, n);
  }

  void pass_once(const std::vector<double>& t_s, std::vector<double>& values, std::size_t n) const {
    const double tau_s = time_constant_s / std::round(poles);
    Decay decay(tau_s);
    double behind = 0.0, before = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double now = values[i];
      if (i > 0) {
        const double interval_s = t_s[i] - t_s[i - 1];
        const double a_second = wrap_degrees(now - before) / interval_s;
        behind -= (1.0 - decay.over(interval_s)) * (behind + a_second * tau_s);
      }
      before = now;
      values[i] += behind;
    }
  }
};

}  // namespace gyrostat::effects
