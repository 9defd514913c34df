#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The output is a fraction more than the rate (IEEE Std 528, scale factor error): + error rate.
struct ScaleFactor {
  double error = 0.01;

  static constexpr std::string_view title = "the rate is scaled";
  static constexpr Stage stage = Stage::electronics;
  static constexpr bool sample_by_sample = true;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps};

  static constexpr auto fields() {
    using P = ScaleFactor;
    return std::array{
        Field{"error", &P::error, "1", ranges::any, "share of the rate that is added"},
    };
  }

  static constexpr ScaleFactor absent() { return {.error = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] += error * series.rate_ref_dps[i];
  }
};

}  // namespace gyrostat::effects
