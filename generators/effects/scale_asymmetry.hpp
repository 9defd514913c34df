#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Scale factors of the two directions differ (IEEE Std 528, asymmetry): + error |rate|. Where one
/// direction alone is off, it is by twice the error, and the other is right.
struct ScaleAsymmetry {
  double error = 0.01;
  double one_side = 0.0;

  static constexpr std::string_view title = "the two directions are scaled differently";
  static constexpr Stage stage = Stage::electronics;
  static constexpr bool sample_by_sample = true;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps};

  static constexpr auto fields() {
    using P = ScaleAsymmetry;
    return std::array{
        Field{"error", &P::error, "1", ranges::any, "half the difference of the scale factors"},
        Field{"one_side", &P::one_side, "1", Range{.from = -1, .to = 1, .whole = true},
              "1 or -1: rates of that sign alone are off; 0: both, half each"},
    };
  }

  static constexpr ScaleAsymmetry absent() { return {.error = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] += error * shown(series.rate_ref_dps[i]);
  }

 private:
  double shown(double rate_dps) const {
    if (one_side == 0.0) return std::abs(rate_dps);
    return rate_dps * one_side > 0.0 ? 2.0 * std::abs(rate_dps) : 0.0;
  }
};

}  // namespace gyrostat::effects
