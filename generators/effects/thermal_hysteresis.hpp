#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Bias that differs between rising and falling temperature: the play (backlash) operator
/// y <- clamp(y, T - width, T + width), B += amplitude (T - y) / width, so that a temperature
/// moving one way for more than 2 width sits on the branch +amplitude or -amplitude.
/// (Krasnosel'skii and Pokrovskii, Systems with Hysteresis, 1989, ch. 1.) Plays of three
/// narrower widths may be added, which makes a loop of any convex course. Or the branch is
/// approached the slower, the nearer it is: B += amplitude z, dz = (dT - |dT| z) / width (Dahl,
/// AIAA Journal 14, 1976), T behind a play of a twentieth of the width: what a thermometer's noise
/// goes to and fro by would wear z away. Or the branch is the sign of dT/dt alone, between turns by
/// more than the width.
struct ThermalHysteresis {
  double amplitude_dps = 0.01;
  double width_C = 3.0;
  double gradual = 0.0;
  double first_branch = 0.0;
  double of_three_quarters_dps = 0.0, of_half_dps = 0.0, of_quarter_dps = 0.0;
  double sudden = 0.0;

  static constexpr std::string_view title = "bias depends on the direction of temperature";
  static constexpr Stage stage = Stage::sensing;
  static constexpr std::array needs = {&Series::temperature_C, &Series::thermal_bias_dps};

  static constexpr auto fields() {
    using P = ThermalHysteresis;
    return std::array{
        Field{"amplitude_dps", &P::amplitude_dps, "dps", ranges::any,
              "half the distance between the two branches"},
        Field{"width_C", &P::width_C, "°C", ranges::positive,
              "half the temperature change that leads from one branch to the other"},
        Field{"gradual", &P::gradual, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: the branch is approached exponentially, over that change; 0: by play"},
        Field{
            "first_branch", &P::first_branch, "1", Range{.from = -1, .to = 1},
            "where the first sample is: 1 on the branch of a rising temperature, -1 on the other"},
        Field{"of_three_quarters_dps", &P::of_three_quarters_dps, "dps", ranges::any,
              "amplitude of a play of three quarters of the width besides"},
        Field{"of_half_dps", &P::of_half_dps, "dps", ranges::any, "of half the width"},
        Field{"of_quarter_dps", &P::of_quarter_dps, "dps", ranges::any, "of a quarter"},
        Field{
            "sudden", &P::sudden, "1", Range{.from = 0, .to = 1, .whole = true},
            "1: the branch is the sign of what the temperature does, whose turns by less than the "
            "width are none"},
    };
  }

  static constexpr ThermalHysteresis absent() { return {.amplitude_dps = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    if (series.temperature_C.empty()) return;
    if (sudden > 0.5) return change_at_turns(series);
    if (gradual > 0.5) return approach(series);
    play(series, width_C, amplitude_dps);
    for (const auto& [share, narrower_dps] :
         {std::pair{0.75, of_three_quarters_dps}, {0.5, of_half_dps}, {0.25, of_quarter_dps}})
      if (narrower_dps != 0.0) play(series, share * width_C, narrower_dps);
  }

 private:
  void play(Series& series, double half_C, double branch_dps) const {
    double play_C = series.temperature_C.front() - first_branch * half_C;
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double T = series.temperature_C[i];
      play_C = std::clamp(play_C, T - half_C, T + half_C);
      series.thermal_bias_dps[i] += branch_dps * (T - play_C) / half_C;
    }
  }

  /// An extreme that lasts, as that of a rounded temperature, is turned at in its middle.
  void change_at_turns(Series& series) const {
    const auto& T = series.temperature_C;
    const std::size_t n = samples_with(series, needs);
    struct Extreme {
      double value_C;
      std::size_t first, last;
      /// Whether that is further, or as far, on the way that `sign` says.
      void reach(double now_C, std::size_t at, double sign) {
        if (sign * now_C > sign * value_C) *this = {now_C, at, at};
        if (now_C == value_C) last = at;
      }
      bool is_left_by(double now_C, double sign, double width_C) const {
        return sign * (value_C - now_C) > width_C;
      }
      std::size_t middle() const { return (first + last + 1) / 2; }
    };
    Extreme high{T.front(), 0, 0}, low = high;
    double sign = 0.0;  // of the branch, once it shows
    std::size_t begun = 0;
    const auto turn = [&](const Extreme& at) {
      const double branch = sign == 0.0 ? first_branch : sign;
      for (; begun < at.middle(); ++begun) series.thermal_bias_dps[begun] += amplitude_dps * branch;
    };
    for (std::size_t i = 0; i < n; ++i) {
      high.reach(T[i], i, 1.0);
      low.reach(T[i], i, -1.0);
      if (sign >= 0.0 && high.is_left_by(T[i], 1.0, width_C)) {
        if (sign > 0.0) turn(high);
        sign = -1.0;
        low = {T[i], i, i};
      } else if (sign <= 0.0 && low.is_left_by(T[i], -1.0, width_C)) {
        if (sign < 0.0) turn(low);
        sign = 1.0;
        high = {T[i], i, i};
      }
    }
    turn({0.0, n, n});
  }

  /// From one temperature to the next, monotonically, in closed form.
  void approach(Series& series) const {
    const double noise_C = 0.05 * width_C;
    double share = first_branch, before_C = series.temperature_C.front();
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double T = series.temperature_C[i];
      const double now_C = std::clamp(before_C, T - noise_C, T + noise_C);
      const double rise_C = now_C - std::exchange(before_C, now_C);
      const double branch = rise_C < 0.0 ? -1.0 : 1.0;
      share = branch + (share - branch) * std::exp(-std::abs(rise_C) / width_C);
      series.thermal_bias_dps[i] += amplitude_dps * share;
    }
  }
};

}  // namespace gyrostat::effects
