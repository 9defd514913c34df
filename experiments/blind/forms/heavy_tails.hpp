#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::gap::forms {

/// The white noise is Student's t in place of normal: each deviate is divided by the root of a
/// chi-squared over its degrees of freedom.
struct HeavyTails {
  double degrees_of_freedom = 3.0;

  static constexpr std::string_view title = "the white noise is Student's";
  static constexpr Stage stage = Stage::noise;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps,
                                       &Series::thermal_bias_dps, &Series::random_error_dps};
  static constexpr double normal_enough = 100.0;

  static constexpr auto fields() {
    using P = HeavyTails;
    return std::array{Field{"degrees_of_freedom", &P::degrees_of_freedom, "1",
                            Range{.from = 1, .to = normal_enough, .whole = true},
                            "of Student's distribution; at 100 the noise stays normal"}};
  }
  static constexpr HeavyTails absent() { return {.degrees_of_freedom = normal_enough}; }

  void apply(Series& series, const Noise& noise) const {
    if (degrees_of_freedom >= normal_enough) return;
    Deviates deviates(noise.stream("heavy_tails"));
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      double squares = 0.0;
      for (int k = 0; k < std::lround(degrees_of_freedom); ++k) {
        const double deviate = deviates.next();
        squares += deviate * deviate;
      }
      const double white = series.gyro_dps[i] - series.rate_ref_dps[i] -
                           series.thermal_bias_dps[i] - series.random_error_dps[i];
      series.gyro_dps[i] += white * (std::sqrt(degrees_of_freedom / squares) - 1.0);
    }
  }
};

}  // namespace gyrostat::gap::forms
