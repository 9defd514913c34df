#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/butterworth.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The sensor follows the rate through a low-pass filter at its bandwidth (IEEE Std 1554,
/// bandwidth): equal poles, a rate being held over the interval before its sample, or
/// Butterworth's. At the first sample it has come to rest.
struct SensorBandwidth {
  double cutoff_hz = 5.0;
  double poles = 1.0;
  double maximally_flat = 0.0;

  static constexpr int most_poles = 8;

  static constexpr std::string_view title = "the rate is low-passed";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps};

  static constexpr auto fields() {
    using P = SensorBandwidth;
    return std::array{
        Field{"cutoff_hz", &P::cutoff_hz, "Hz", ranges::positive,
              "frequency at which each pole, or all of Butterworth's, has taken 3 dB"},
        Field{"poles", &P::poles, "1", Range{.from = 1, .to = most_poles, .whole = true},
              "how many poles"},
        Field{"maximally_flat", &P::maximally_flat, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: Butterworth's poles; 0: equal ones"},
    };
  }

  static constexpr SensorBandwidth absent() { return {.cutoff_hz = 1e9}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    const std::size_t samples = samples_with(series, needs);
    if (samples < 2) return;
    const auto count =
        static_cast<std::size_t>(std::clamp(std::lround(poles), 1L, long{most_poles}));
    const auto& rate = series.rate_ref_dps;
    if (maximally_flat > 0.5) {
      Butterworth sensed(cutoff_hz * series.duration_s() / static_cast<double>(samples - 1), count);
      for (std::size_t i = 0; i < samples; ++i)
        series.gyro_dps[i] += rate[0] + sensed(rate[i] - rate[0]) - rate[i];
      return;
    }
    Decay decay(0.5 / (std::numbers::pi * cutoff_hz));
    std::array<double, most_poles> sensed{};
    for (std::size_t i = 0; i < samples; ++i) {
      const double left = decay(series.t_s, i);
      double passed = rate[i];
      for (std::size_t k = 0; k < count; ++k)
        passed = sensed[k] = passed + left * (sensed[k] - passed);
      series.gyro_dps[i] += passed - rate[i];
    }
  }
};

}  // namespace gyrostat::effects
