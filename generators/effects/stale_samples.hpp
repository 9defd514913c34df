#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The recorder repeats its last value where a new one came too late. Repeats last a geometric
/// number of samples and a fresh one follows each, so that the share of repeated samples is p m /
/// (1 + p m) with p = probability and m = mean run. Or they come at even distances and are equally
/// long, as where the sensor's clock is slower than the recorder's: each 1 / p + m samples one
/// ends. Of a recorder that is R times as fast as its sensor all is repeated but each R-th sample:
/// p = 1 and m = R - 1. A buffer of several places may hold an older value than the last.
struct StaleSamples {
  double probability = 0.01;
  double mean_run = 1.0;
  double regular = 0.0;
  double back = 1.0;

  static constexpr std::string_view title = "values are repeated";
  static constexpr Stage stage = Stage::transport;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = StaleSamples;
    return std::array{
        Field{"probability", &P::probability, "1", ranges::fraction,
              "chance that a repeat begins at a sample"},
        Field{"mean_run", &P::mean_run, "samples", Range{.from = 1, .to = 1e6},
              "mean length of a repeat"},
        Field{"regular", &P::regular, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: repeats come at even distances and are equally long; 0: by chance"},
        Field{"back", &P::back, "samples", Range{.from = 1, .to = 64, .whole = true},
              "how old the repeated value is"},
    };
  }

  static constexpr StaleSamples absent() { return {.probability = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    if (probability == 0.0) return;
    const auto begins = noise.stream("stale_samples/begins");
    const auto goes_on = noise.stream("stale_samples/goes_on");
    const double turn = noise.stream("stale_samples/first").uniform(0);
    const double distance = 1.0 / probability + mean_run;
    const auto is_in_repeat = [&](std::size_t i) {
      const double rounds = turn + static_cast<double>(i) / distance;
      return (rounds - std::floor(rounds)) * distance * probability >= 1.0;
    };
    bool stale = false;
    const auto age = static_cast<std::size_t>(back);
    for (std::size_t i = 1, n = samples_with(series, needs); i < n; ++i) {
      if (regular > 0.5)
        stale = is_in_repeat(i);
      else
        stale = stale ? goes_on.uniform(i) < 1.0 - 1.0 / mean_run : begins.uniform(i) < probability;
      if (stale && i >= age) series.gyro_dps[i] = series.gyro_dps[i - age];
    }
  }
};

}  // namespace gyrostat::effects
