#pragma once

#include <cmath>
#include <numbers>

#include "core/fields.hpp"
#include "core/random.hpp"
#include "core/series.hpp"
#include "generators/stage.hpp"

namespace gyrostat::effects {

/// The sensor follows the rate through one pole at its bandwidth (IEEE Std 1554).
struct SensorBandwidth {
  double cutoff_hz = 5.0;

  static constexpr std::string_view title = "the rate is low-passed";
  static constexpr Stage stage = Stage::electronics;

  static constexpr auto fields() {
    using P = SensorBandwidth;
    return std::array{
        Field{"cutoff_hz", &P::cutoff_hz, "Hz", ranges::positive,
              "frequency at which the response has lost 3 dB"},
    };
  }

  static constexpr SensorBandwidth absent() { return {.cutoff_hz = 1e9}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    if (series.size() < 2) return;
    const double pole = std::exp(-2.0 * std::numbers::pi * cutoff_hz / series.rate_hz());
    double sensed = series.rate_ref_dps.front();
    for (std::size_t i = 0; i < series.size(); ++i) {
      const double rate = series.rate_ref_dps[i];
      sensed = pole * sensed + (1.0 - pole) * rate;
      series.gyro_dps[i] += sensed - rate;
    }
  }
};

}  // namespace gyrostat::effects
