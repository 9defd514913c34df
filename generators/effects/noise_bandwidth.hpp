#pragma once

#include <cmath>
#include <numbers>

#include "core/fields.hpp"
#include "core/random.hpp"
#include "core/series.hpp"
#include "generators/stage.hpp"

namespace gyrostat::effects {

/// An output filter of unit gain at rest colours the white noise: one pole at the cut-off frequency,
/// exact between samples (IEEE Std 1554, bandwidth). The noise keeps its density well below it.
struct NoiseBandwidth {
  double cutoff_hz = 20.0;

  static constexpr std::string_view title = "an output filter colours the white noise";
  static constexpr Stage stage = Stage::noise;

  static constexpr auto fields() {
    using P = NoiseBandwidth;
    return std::array{
        Field{"cutoff_hz", &P::cutoff_hz, "Hz", ranges::positive,
              "frequency at which the noise has lost 3 dB"},
    };
  }

  static constexpr NoiseBandwidth absent() { return {.cutoff_hz = 1e9}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    if (series.size() < 2) return;
    const double pole =
        std::exp(-2.0 * std::numbers::pi * cutoff_hz / series.rate_hz());
    double filtered = 0.0;
    for (std::size_t i = 0; i < series.size(); ++i) {
      const double quiet =
          series.rate_ref_dps[i] + series.thermal_bias_dps[i] + series.random_error_dps[i];
      const double white = series.gyro_dps[i] - quiet;
      filtered = i == 0 ? white * std::sqrt((1.0 - pole) / (1.0 + pole))
                        : pole * filtered + (1.0 - pole) * white;
      series.gyro_dps[i] = quiet + filtered;
    }
  }
};

}  // namespace gyrostat::effects
