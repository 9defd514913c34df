#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/narrow_band.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Narrow-band random vibration that comes and goes, as of a telephone nearby: exponential times
/// with it and without it follow one another, stationary from the first sample. With
/// s = duration / (duration + interval) the share of time and rho the autocorrelation of
/// vibration, the autocovariance at lag h is
///   std^2 rho(h) (s^2 + s (1 - s) exp(-h / duration - h / interval)),
/// the product of two independent processes (Machlup, J. Appl. Phys. 25, 1954).
struct VibrationBursts {
  double std_dps = 0.1;
  double centre_hz = 10.0;
  double bandwidth_hz = 1.0;
  double mean_duration_s = 5.0;
  double mean_interval_s = 60.0;

  static constexpr std::string_view title = "vibration that comes and goes";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = VibrationBursts;
    return std::array{
        Field{"std_dps", &P::std_dps, "dps", ranges::non_negative,
              "standard deviation while it is there"},
        Field{"centre_hz", &P::centre_hz, "Hz", ranges::non_negative,
              "frequency of the highest density"},
        Field{"bandwidth_hz", &P::bandwidth_hz, "Hz", ranges::positive,
              "width of the line between its half-power points"},
        Field{"mean_duration_s", &P::mean_duration_s, "s", Range{.from = 1e-3},
              "mean length of a burst"},
        Field{"mean_interval_s", &P::mean_interval_s, "s", Range{.from = 1e-3},
              "mean time from the end of a burst to the next"},
    };
  }

  static constexpr VibrationBursts absent() { return {.std_dps = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    NarrowBand line(centre_hz, bandwidth_hz, noise.stream("vibration_bursts/in_phase"),
                    noise.stream("vibration_bursts/quadrature"));
    const auto chance = noise.stream("vibration_bursts/time");
    std::uint64_t draw = 0;
    bool is_on = chance.uniform(draw++) * (mean_duration_s + mean_interval_s) < mean_duration_s;
    const auto stay_s = [&] {
      return -std::log(chance.uniform(draw++)) * (is_on ? mean_duration_s : mean_interval_s);
    };
    double next_s = stay_s();
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      for (; series.t_s[i] - series.t_s[0] >= next_s; next_s += stay_s()) is_on = !is_on;
      const double vibration = line(series.t_s, i);
      if (is_on) series.gyro_dps[i] += std_dps * vibration;
    }
  }
};

}  // namespace gyrostat::effects
