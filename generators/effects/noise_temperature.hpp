#pragma once

#include <algorithm>
#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The white noise grows with temperature: its standard deviation is multiplied by
/// 1 + relative (T - reference) + curvature (T - reference)^2, not below 0.
struct NoiseTemperature {
  double relative_per_C = 0.02;
  double reference_C = 25.0;
  double curvature_per_C2 = 0.0;

  static constexpr std::string_view title = "the noise depends on temperature";
  static constexpr Stage stage = Stage::noise;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps,
                                       &Series::thermal_bias_dps, &Series::random_error_dps,
                                       &Series::temperature_C};

  static constexpr auto fields() {
    using P = NoiseTemperature;
    return std::array{
        Field{"relative_per_C", &P::relative_per_C, "1/°C", ranges::any,
              "relative change of the standard deviation per degree"},
        Field{"reference_C", &P::reference_C, "°C", ranges::any,
              "temperature at which the noise is as stated"},
        Field{"curvature_per_C2", &P::curvature_per_C2, "1/°C²", ranges::any,
              "relative change of the standard deviation per squared degree"},
    };
  }

  static constexpr NoiseTemperature absent() { return {.relative_per_C = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double white = error_beside_drift(series, i);
      const double off_C = series.temperature_C[i] - reference_C;
      const double gain = std::max(0.0, 1.0 + (relative_per_C + curvature_per_C2 * off_C) * off_C);
      series.gyro_dps[i] += (gain - 1.0) * white;
    }
  }
};

}  // namespace gyrostat::effects
