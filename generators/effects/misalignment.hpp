#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The sensitive axis is not quite the one that it is called: the gyro shows a share of the rates
/// about the two other axes (IEEE Std 528, input-axis misalignment; IEEE Std 2700, cross-axis
/// sensitivity). A share is the angle in radians, while that is small.
struct Misalignment {
  double share_1 = 0.01;
  double share_2 = 0.0;

  static constexpr std::string_view title = "the gyro shows a share of the other axes' rates";
  static constexpr Stage stage = Stage::electronics;
  static constexpr bool sample_by_sample = true;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::cross_rate_1_dps,
                                       &Series::cross_rate_2_dps};

  static constexpr auto fields() {
    using P = Misalignment;
    return std::array{
        Field{"share_1", &P::share_1, "1", ranges::any,
              "share of the rate about the next axis in the order x, y, z, x"},
        Field{"share_2", &P::share_2, "1", ranges::any, "share of the rate about the one after it"},
    };
  }

  static constexpr Misalignment absent() { return {.share_1 = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] +=
          share_1 * series.cross_rate_1_dps[i] + share_2 * series.cross_rate_2_dps[i];
  }
};

}  // namespace gyrostat::effects
