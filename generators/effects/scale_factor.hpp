#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The output is a fraction more than the rate (IEEE Std 528, scale factor error), and that
/// fraction may grow with the rate's square (its nonlinearity): + (error + cubic rate^2) rate.
struct ScaleFactor {
  double error = 0.01;
  double cubic_per_dps2 = 0.0;

  static constexpr std::string_view title = "the rate is scaled";
  static constexpr Stage stage = Stage::electronics;
  static constexpr bool sample_by_sample = true;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps};

  static constexpr auto fields() {
    using P = ScaleFactor;
    return std::array{
        Field{"error", &P::error, "1", ranges::any, "share of the rate that is added"},
        Field{"cubic_per_dps2", &P::cubic_per_dps2, "1/dps²", ranges::any,
              "what it grows by with the square of the rate"},
    };
  }

  static constexpr ScaleFactor absent() { return {.error = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double rate = series.rate_ref_dps[i];
      series.gyro_dps[i] += (error + cubic_per_dps2 * rate * rate) * rate;
    }
  }
};

}  // namespace gyrostat::effects
