#pragma once

#include <gyrostat/generators/effects/compass_lag.hpp>

namespace gyrostat::gap::forms {

/// The compass trails through two poles in a row, half of the time constant each.
struct SecondOrderCompass {
  double time_constant_s = 0.5;

  static constexpr std::string_view title = "the compass trails the heading through two poles";
  static constexpr Stage stage = Stage::compass;
  static constexpr std::array needs = {&Series::heading_deg};

  static constexpr auto fields() {
    using P = SecondOrderCompass;
    return std::array{
        Field{"time_constant_s", &P::time_constant_s, "s", ranges::non_negative,
              "time constants of both, added"},
    };
  }
  static constexpr SecondOrderCompass absent() { return {.time_constant_s = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    const effects::CompassLag pole{.time_constant_s = 0.5 * time_constant_s};
    pole.apply(series, noise);
    pole.apply(series, noise);
  }
};

}  // namespace gyrostat::gap::forms
