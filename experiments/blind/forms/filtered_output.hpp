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

namespace gyrostat::gap::forms {

/// The output filter stands behind everything: rate, bias and noise pass the same poles.
struct FilteredOutput {
  double cutoff_hz = 5.0;
  double poles = 1.0;

  static constexpr std::string_view title = "rate and noise pass one filter";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};
  static constexpr int most_poles = 8;

  static constexpr auto fields() {
    using P = FilteredOutput;
    return std::array{
        Field{"cutoff_hz", &P::cutoff_hz, "Hz", ranges::positive,
              "frequency at which each pole has taken 3 dB"},
        Field{"poles", &P::poles, "1", Range{.from = 1, .to = most_poles, .whole = true},
              "how many poles"},
    };
  }
  static constexpr FilteredOutput absent() { return {.cutoff_hz = 1e9}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (int k = 0; k < std::lround(poles); ++k) {
      Decay decay(0.5 / (std::numbers::pi * cutoff_hz));
      double passed = series.gyro_dps.empty() ? 0.0 : series.gyro_dps.front();
      for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
        const double value = series.gyro_dps[i];
        series.gyro_dps[i] = passed = value + decay(series.t_s, i) * (passed - value);
      }
    }
  }
};

}  // namespace gyrostat::gap::forms
