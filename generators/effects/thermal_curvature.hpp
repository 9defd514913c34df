#pragma once

#include <algorithm>
#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Bias that is no line over temperature:
///   B += curvature (T - reference)^2 + cubic (T - reference)^3 + kink max(0, T - at),
/// bent, or of two slopes, as a table of compensation leaves it between its points.
struct ThermalCurvature {
  double curvature_dps_per_C2 = 1e-4;
  double reference_C = 40.0;
  double cubic_dps_per_C3 = 0.0;
  double kink_dps_per_C = 0.0;
  double kink_C = 0.0;

  static constexpr std::string_view title = "bias curves with temperature";
  static constexpr Stage stage = Stage::sensing;
  static constexpr std::array needs = {&Series::temperature_C, &Series::thermal_bias_dps};

  static constexpr auto fields() {
    using P = ThermalCurvature;
    return std::array{
        Field{"curvature_dps_per_C2", &P::curvature_dps_per_C2, "dps/°C²", ranges::any,
              "quadratic coefficient"},
        Field{"reference_C", &P::reference_C, "°C", ranges::any, "temperature without effect"},
        Field{"cubic_dps_per_C3", &P::cubic_dps_per_C3, "dps/°C³", ranges::any,
              "cubic coefficient"},
        Field{"kink_dps_per_C", &P::kink_dps_per_C, "dps/°C", ranges::any,
              "how much more the bias rises by a degree beyond the kink"},
        Field{"kink_C", &P::kink_C, "°C", ranges::any, "temperature of the kink"},
    };
  }

  static constexpr ThermalCurvature absent() {
    return {.curvature_dps_per_C2 = 0.0, .cubic_dps_per_C3 = 0.0, .kink_dps_per_C = 0.0};
  }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double difference = series.temperature_C[i] - reference_C;
      series.thermal_bias_dps[i] +=
          (curvature_dps_per_C2 + cubic_dps_per_C3 * difference) * difference * difference +
          kink_dps_per_C * std::max(0.0, series.temperature_C[i] - kink_C);
    }
  }
};

}  // namespace gyrostat::effects
