#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Iron that passes by unnoticed: at the times of a Poisson process a normal offset stands on the
/// heading for an exponential time, and nothing flags it.
struct MagneticBursts {
  double bursts_per_hour = 10.0;
  double mean_duration_s = 30.0;
  double std_deg = 5.0;

  static constexpr std::string_view title = "unflagged magnetic disturbances";
  static constexpr Stage stage = Stage::compass;
  static constexpr std::array needs = {&Series::heading_deg};

  static constexpr auto fields() {
    using P = MagneticBursts;
    return std::array{
        Field{"bursts_per_hour", &P::bursts_per_hour, "1/h", Range{.from = 0, .to = 1e6},
              "mean number of disturbances in an hour without one"},
        Field{"mean_duration_s", &P::mean_duration_s, "s", ranges::positive,
              "mean length of a disturbance"},
        Field{"std_deg", &P::std_deg, "deg", ranges::non_negative,
              "standard deviation of the offset"},
    };
  }

  static constexpr MagneticBursts absent() { return {.std_deg = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    const auto chance = noise.stream("magnetic_bursts/time");
    const auto size = noise.stream("magnetic_bursts/size");
    std::uint64_t draw = 0, burst = 0;
    const auto exponential = [&](double mean) { return -std::log(chance.uniform(draw++)) * mean; };
    double start_s = exponential(3600.0 / bursts_per_hour);
    double end_s = start_s + exponential(mean_duration_s), offset_deg = std_deg * size.normal(0);
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double t_s = series.t_s[i] - series.t_s[0];
      while (t_s >= end_s) {
        start_s = end_s + exponential(3600.0 / bursts_per_hour);
        end_s = start_s + exponential(mean_duration_s);
        offset_deg = std_deg * size.normal(++burst);
      }
      if (t_s >= start_s) series.heading_deg[i] += offset_deg;
    }
  }
};

}  // namespace gyrostat::effects
