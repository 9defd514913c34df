#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// A bias that grows evenly with time (IEEE Std 952 annex C, rate ramp).
struct RateRamp {
  double slope_dps_per_s = 1e-5;

  static constexpr std::string_view title = "the bias drifts evenly with time";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = RateRamp;
    return std::array{
        Field{"slope_dps_per_s", &P::slope_dps_per_s, "dps/s", ranges::any,
              "growth of the bias per second"},
    };
  }

  static constexpr RateRamp absent() { return {.slope_dps_per_s = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] += slope_dps_per_s * (series.t_s[i] - series.t_s.front());
  }
};

}  // namespace gyrostat::effects
