#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Contaminated normal noise: each sample is, with a small probability, hit by a second, much wider
/// white noise (Tukey 1960), or by an error of about one size and either sign.
struct Outliers {
  double probability = 1e-3;
  double std_dps = 1.0;
  double mean_size_dps = 0.0;
  double before_filter = 0.0;

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
        Field{"mean_size_dps", &P::mean_size_dps, "dps", ranges::non_negative,
              "mean size of the gross error, up or down, about which it has that deviation"},
        Field{"before_filter", &P::before_filter, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: of the white noise, before what follows in the scenario and filters it; 0: behind "
              "such a filter"},
    };
  }

  static constexpr Outliers absent() { return {.probability = 0.0}; }

  Stage acts_at() const { return before_filter > 0.5 ? Stage::noise : stage; }

  void apply(Series& series, const Noise& noise) const {
    const auto chance = noise.stream("outliers/chance");
    const auto size = noise.stream("outliers/size");
    const auto sign = noise.stream("outliers/sign");
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      if (!(chance.uniform(i) < probability)) continue;
      const double mean_dps = mean_size_dps == 0.0    ? 0.0
                              : sign.uniform(i) < 0.5 ? -mean_size_dps
                                                      : mean_size_dps;
      series.gyro_dps[i] += mean_dps + std_dps * size.normal(i);
    }
  }
};

}  // namespace gyrostat::effects
