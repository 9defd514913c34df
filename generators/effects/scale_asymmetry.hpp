#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Scale factors of the two directions differ (IEEE Std 528, asymmetry): + error |rate|.
struct ScaleAsymmetry {
  double error = 0.01;

  static constexpr std::string_view title = "the two directions are scaled differently";
  static constexpr Stage stage = Stage::electronics;
  static constexpr bool sample_by_sample = true;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps};

  static constexpr auto fields() {
    using P = ScaleAsymmetry;
    return std::array{
        Field{"error", &P::error, "1", ranges::any, "half the difference of the scale factors"},
    };
  }

  static constexpr ScaleAsymmetry absent() { return {.error = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] += error * std::abs(series.rate_ref_dps[i]);
  }
};

}  // namespace gyrostat::effects
