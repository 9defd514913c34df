#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The bias follows a temperature that trails the measured one: B += sensitivity (T_lag - T) with
/// T_lag' = (T - T_lag) / time constant, started at the first temperature; or one that trails that
/// in turn, as behind several masses. To first order in the time constant it is
/// -sensitivity time_constant T', which the linear drift already contains.
struct ThermalLag {
  double sensitivity_dps_per_C = 0.005;
  double time_constant_s = 120.0;
  double poles = 1.0;

  static constexpr int most_poles = 4;

  static constexpr std::string_view title = "the bias trails the temperature";
  static constexpr Stage stage = Stage::sensing;
  static constexpr std::array needs = {&Series::temperature_C, &Series::thermal_bias_dps};

  static constexpr auto fields() {
    using P = ThermalLag;
    return std::array{
        Field{"sensitivity_dps_per_C", &P::sensitivity_dps_per_C, "dps/°C", ranges::any,
              "bias per degree of difference"},
        Field{"time_constant_s", &P::time_constant_s, "s", ranges::positive,
              "time constants of all poles, added"},
        Field{"poles", &P::poles, "1", Range{.from = 1, .to = most_poles, .whole = true},
              "how many poles"},
    };
  }

  static constexpr ThermalLag absent() { return {.sensitivity_dps_per_C = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    std::array<double, most_poles> lagged{};
    const auto count =
        static_cast<std::size_t>(std::clamp(std::lround(poles), 1L, long{most_poles}));
    Decay decay(time_constant_s / static_cast<double>(count));
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double T = series.temperature_C[i], left = decay(series.t_s, i);
      double lagged_C = T;
      for (std::size_t k = 0; k < count; ++k)
        lagged_C = lagged[k] = lagged_C + left * (lagged[k] - lagged_C);
      series.thermal_bias_dps[i] += sensitivity_dps_per_C * (lagged_C - T);
    }
  }
};

}  // namespace gyrostat::effects
