#pragma once

#include <array>
#include <numbers>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The sensor follows the rate through one pole at its bandwidth (IEEE Std 1554,
/// bandwidth), a rate being held over the interval before its sample.
struct SensorBandwidth {
  double cutoff_hz = 5.0;

  static constexpr std::string_view title = "the rate is low-passed";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps};

  static constexpr auto fields() {
    using P = SensorBandwidth;
    return std::array{
        Field{"cutoff_hz", &P::cutoff_hz, "Hz", ranges::positive,
              "frequency at which the response has lost 3 dB"},
    };
  }

  static constexpr SensorBandwidth absent() { return {.cutoff_hz = 1e9}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    Decay decay(0.5 / (std::numbers::pi * cutoff_hz));
    double sensed = 0.0;
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double rate = series.rate_ref_dps[i];
      sensed = rate + decay(series.t_s, i) * (sensed - rate);
      series.gyro_dps[i] += sensed - rate;
    }
  }
};

}  // namespace gyrostat::effects
