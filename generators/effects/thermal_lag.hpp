#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The bias follows a temperature that trails the measured one: B += sensitivity (T_lag - T) with
/// T_lag' = (T - T_lag) / time constant, started at the first temperature. To
/// first order in the time constant it is -sensitivity time_constant T', which the linear drift
/// already contains.
struct ThermalLag {
  double sensitivity_dps_per_C = 0.005;
  double time_constant_s = 120.0;

  static constexpr std::string_view title = "the bias trails the temperature";
  static constexpr Stage stage = Stage::sensing;
  static constexpr std::array needs = {&Series::temperature_C, &Series::thermal_bias_dps};

  static constexpr auto fields() {
    using P = ThermalLag;
    return std::array{
        Field{"sensitivity_dps_per_C", &P::sensitivity_dps_per_C, "dps/°C", ranges::any,
              "bias per degree of difference"},
        Field{"time_constant_s", &P::time_constant_s, "s", ranges::positive,
              "time constant of the lag"},
    };
  }

  static constexpr ThermalLag absent() { return {.sensitivity_dps_per_C = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    Decay decay(time_constant_s);
    double lagged_C = 0.0;
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double T = series.temperature_C[i];
      lagged_C = T + decay(series.t_s, i) * (lagged_C - T);
      series.thermal_bias_dps[i] += sensitivity_dps_per_C * (lagged_C - T);
    }
  }
};

}  // namespace gyrostat::effects
