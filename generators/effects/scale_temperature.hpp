#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The scale factor depends on temperature (IEEE Std 952, scale factor sensitivity to
/// temperature):
/// + (scale (T - reference) + curvature (T - reference)^2) rate.
struct ScaleTemperature {
  double scale_per_C = 2e-4;
  double reference_C = 25.0;
  double curvature_per_C2 = 0.0;

  static constexpr std::string_view title = "the scale factor depends on temperature";
  static constexpr Stage stage = Stage::electronics;
  static constexpr bool sample_by_sample = true;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps,
                                       &Series::temperature_C};

  static constexpr auto fields() {
    using P = ScaleTemperature;
    return std::array{
        Field{"scale_per_C", &P::scale_per_C, "1/°C", ranges::any,
              "share of the rate that is added per degree"},
        Field{"reference_C", &P::reference_C, "°C", ranges::any,
              "temperature at which the scale factor is right"},
        Field{"curvature_per_C2", &P::curvature_per_C2, "1/°C²", ranges::any,
              "share of the rate that is added per squared degree"},
    };
  }

  static constexpr ScaleTemperature absent() { return {.scale_per_C = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double off_C = series.temperature_C[i] - reference_C;
      series.gyro_dps[i] +=
          (scale_per_C + curvature_per_C2 * off_C) * off_C * series.rate_ref_dps[i];
    }
  }
};

}  // namespace gyrostat::effects
