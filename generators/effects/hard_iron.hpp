#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/compass_deviation.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// A magnet that turns with the vehicle: heading += amplitude sin(heading + phase), one period a
/// turn (compass deviation, coefficients B and C).
struct HardIron {
  double amplitude_deg = 3.0;
  double phase_deg = 0.0;
  double exact = 0.0;

  static constexpr std::string_view title = "heading error of one period a turn";
  static constexpr Stage stage = Stage::compass;
  static constexpr std::array needs = {&Series::heading_deg};

  static constexpr auto fields() {
    using P = HardIron;
    return std::array{
        Field{"amplitude_deg", &P::amplitude_deg, "deg", ranges::non_negative,
              "largest heading error"},
        Field{"phase_deg", &P::phase_deg, "deg", ranges::any, "phase of the error at heading 0"},
        Field{"exact", &P::exact, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: as fields add up, with overtones; 0: one harmonic alone"},
    };
  }

  static constexpr HardIron absent() { return {.amplitude_deg = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    constexpr double rad = std::numbers::pi / 180.0;
    for (double& heading : series.heading_deg)
      heading += compass_deviation_deg(amplitude_deg, (heading + phase_deg) * rad, exact);
  }
};

}  // namespace gyrostat::effects
