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
/// -sensitivity time_constant T', which the linear drift already contains. Where the masses begin
/// at another temperature, what the bias has of it is lost with the time constant.
struct ThermalLag {
  double sensitivity_dps_per_C = 0.005;
  double time_constant_s = 120.0;
  double poles = 1.0;
  double start_dps = 0.0;

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
        Field{"start_dps", &P::start_dps, "dps", ranges::any,
              "bias at the first sample from masses that are not yet at its temperature"},
    };
  }

  static constexpr ThermalLag absent() { return {.sensitivity_dps_per_C = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    std::array<double, most_poles> lagged{}, left_of_start{};
    left_of_start.fill(start_dps);
    const auto count =
        static_cast<std::size_t>(std::clamp(std::lround(poles), 1L, long{most_poles}));
    Decay decay(time_constant_s / static_cast<double>(count));
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double T = series.temperature_C[i], left = decay(series.t_s, i);
      double lagged_C = T, start = i == 0 ? start_dps : 0.0;
      for (std::size_t k = 0; k < count; ++k) {
        lagged_C = lagged[k] = lagged_C + left * (lagged[k] - lagged_C);
        if (i > 0) start = left_of_start[k] = start + left * (left_of_start[k] - start);
      }
      series.thermal_bias_dps[i] += sensitivity_dps_per_C * (lagged_C - T) + start;
    }
  }
};

}  // namespace gyrostat::effects
