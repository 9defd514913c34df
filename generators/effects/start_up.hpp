#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The bias settles after the sensor is switched on, at the first sample (IEEE Std 528, warm-up
/// time): + amplitude exp(-t / settling time). No temperature tells of it.
struct StartUp {
  double amplitude_dps = 0.05;
  double settling_time_s = 60.0;

  static constexpr std::string_view title = "the bias settles after power-on";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = StartUp;
    return std::array{
        Field{"amplitude_dps", &P::amplitude_dps, "dps", ranges::any,
              "what the first sample has more than the settled bias"},
        Field{"settling_time_s", &P::settling_time_s, "s", ranges::positive,
              "time after which 1/e of it is left"},
    };
  }

  static constexpr StartUp absent() { return {.amplitude_dps = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] +=
          amplitude_dps * std::exp((series.t_s.front() - series.t_s[i]) / settling_time_s);
  }
};

}  // namespace gyrostat::effects
