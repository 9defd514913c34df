#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The recorder repeats its last value where a new one came too late. Repeats last a geometric
/// number of samples and a fresh one follows each, so that the share of repeated samples is p m /
/// (1 + p m) with p = probability and m = mean run.
struct StaleSamples {
  double probability = 0.01;
  double mean_run = 1.0;

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
    };
  }

  static constexpr StaleSamples absent() { return {.probability = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    if (probability == 0.0) return;
    const auto begins = noise.stream("stale_samples/begins");
    const auto goes_on = noise.stream("stale_samples/goes_on");
    bool stale = false;
    for (std::size_t i = 1, n = samples_with(series, needs); i < n; ++i) {
      stale = stale ? goes_on.uniform(i) < 1.0 - 1.0 / mean_run : begins.uniform(i) < probability;
      if (stale) series.gyro_dps[i] = series.gyro_dps[i - 1];
    }
  }
};

}  // namespace gyrostat::effects
