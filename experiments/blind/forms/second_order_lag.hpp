#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::gap::forms {

/// The bias follows a temperature behind two masses in a row, half of the time constant each.
struct SecondOrderLag {
  double sensitivity_dps_per_C = 0.005;
  double time_constant_s = 120.0;

  static constexpr std::string_view title = "the bias trails the temperature through two masses";
  static constexpr Stage stage = Stage::sensing;
  static constexpr std::array needs = {&Series::temperature_C, &Series::thermal_bias_dps};

  static constexpr auto fields() {
    using P = SecondOrderLag;
    return std::array{
        Field{"sensitivity_dps_per_C", &P::sensitivity_dps_per_C, "dps/°C", ranges::any,
              "bias per degree of difference"},
        Field{"time_constant_s", &P::time_constant_s, "s", ranges::positive,
              "time constants of both, added"},
    };
  }
  static constexpr SecondOrderLag absent() { return {.sensitivity_dps_per_C = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    Decay decay(0.5 * time_constant_s);
    double first_C = 0.0, second_C = 0.0;
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double T = series.temperature_C[i], kept = decay(series.t_s, i);
      first_C = T + kept * (first_C - T);
      second_C = first_C + kept * (second_C - first_C);
      series.thermal_bias_dps[i] += sensitivity_dps_per_C * (second_C - T);
    }
  }
};

}  // namespace gyrostat::gap::forms
