#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Contaminated normal noise: each sample is, with a small probability, hit by a second, much wider
/// white noise (Tukey 1960).
struct Outliers {
  double probability = 1e-3;
  double std_dps = 1.0;

  static constexpr std::string_view title = "occasional gross errors";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = Outliers;
    return std::array{
        Field{"probability", &P::probability, "1", ranges::fraction,
              "probability that a sample is hit"},
        Field{"std_dps", &P::std_dps, "dps", ranges::non_negative,
              "standard deviation of the gross error"},
    };
  }

  static constexpr Outliers absent() { return {.probability = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    const auto chance = noise.stream("outliers/chance");
    const auto size = noise.stream("outliers/size");
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      if (chance.uniform(i) < probability) series.gyro_dps[i] += std_dps * size.normal(i);
  }
};

}  // namespace gyrostat::effects
