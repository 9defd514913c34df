#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The output is clipped at the limits of the input range (IEEE Std 528, input range).
struct Saturation {
  double limit_dps = 50.0;

  static constexpr std::string_view title = "the output is clipped";
  static constexpr Stage stage = Stage::conversion;
  static constexpr bool sample_by_sample = true;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = Saturation;
    return std::array{
        Field{"limit_dps", &P::limit_dps, "dps", ranges::positive, "largest output"},
    };
  }

  static constexpr Saturation absent() { return {.limit_dps = 1e9}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (double& z : series.gyro_dps)
      z = z > limit_dps ? limit_dps : z < -limit_dps ? -limit_dps : z;
  }
};

}  // namespace gyrostat::effects
