#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// An output filter of unit gain at rest colours the white noise: equal poles, each exact between
/// samples (IEEE Std 1554, bandwidth). The noise keeps its density well below them.
struct NoiseBandwidth {
  double cutoff_hz = 20.0;
  double poles = 1.0;

  static constexpr std::string_view title = "an output filter colours the white noise";
  static constexpr Stage stage = Stage::noise;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps,
                                       &Series::thermal_bias_dps, &Series::random_error_dps};

  static constexpr auto fields() {
    using P = NoiseBandwidth;
    return std::array{
        Field{"cutoff_hz", &P::cutoff_hz, "Hz", ranges::positive,
              "frequency at which each pole has taken 3 dB"},
        Field{"poles", &P::poles, "1", Range{.from = 1, .to = most_poles, .whole = true},
              "how many poles"},
    };
  }

  static constexpr int most_poles = 8;
  static constexpr NoiseBandwidth absent() { return {.cutoff_hz = 1e9}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    Decay decay(0.5 / (std::numbers::pi * cutoff_hz));
    std::array<double, most_poles> filtered{};
    const auto count =
        static_cast<std::size_t>(std::clamp(std::lround(poles), 1L, long{most_poles}));
    const std::size_t samples = samples_with(series, needs);
    for (std::size_t i = 0; i < samples; ++i) {
      const double white = series.gyro_dps[i] - series.rate_ref_dps[i] -
                           series.thermal_bias_dps[i] - series.random_error_dps[i];
      const std::size_t to = std::max<std::size_t>(i, 1);
      const double pole = samples > 1 ? decay.over(series.t_s[to] - series.t_s[to - 1]) : 0.0;
      double passed = white;
      for (std::size_t k = 0; k < count; ++k)
        passed = filtered[k] = i == 0 ? passed * std::sqrt((1.0 - pole) / (1.0 + pole))
                                      : pole * filtered[k] + (1.0 - pole) * passed;
      series.gyro_dps[i] += passed - white;
    }
  }
};

}  // namespace gyrostat::effects
