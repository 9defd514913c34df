#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The output is clipped at the limits of the input range (IEEE Std 528, input range), or the
/// sensing element is: then what comes after it, bias and noise, goes on beyond. With a knee the
/// output bends into the limit, a parabola from so much of the limit before it to as much beyond.
/// Where a bias was taken out after the converter, it has another limit below zero than above.
struct Saturation {
  double limit_dps = 50.0;
  double of_element = 0.0;
  double knee = 0.0;
  double below_dps = 0.0;

  static constexpr std::string_view title = "the output is clipped";
  static constexpr Stage stage = Stage::conversion;
  static constexpr bool sample_by_sample = true;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = Saturation;
    return std::array{
        Field{"limit_dps", &P::limit_dps, "dps", ranges::positive, "largest output"},
        Field{"of_element", &P::of_element, "1", Range{.from = 0, .to = 2, .whole = true},
              "1: the rate is clipped, and noise comes after; 2: before a filter of the rate, too; "
              "0: the output is"},
        Field{"knee", &P::knee, "1", Range{.from = 0, .to = 1},
              "of the limit, before and beyond it, over which it bends; 0: at once"},
        Field{"below_dps", &P::below_dps, "dps", ranges::non_negative,
              "largest output below zero; 0: as above"},
    };
  }

  static constexpr Saturation absent() { return {.limit_dps = 1e9}; }

  Response response() const {
    if (of_element < 0.5) return Response::none;
    return of_element < 1.5 ? Response::of_electronics : Response::of_element;
  }

  void apply(Series& series, const Noise& /*noise*/) const {
    if (of_element < 0.5) {
      for (double& z : series.gyro_dps) z = clipped(z);
      return;
    }
    constexpr std::array sensed = {&Series::gyro_dps, &Series::rate_ref_dps};
    for (std::size_t i = 0, n = samples_with(series, sensed); i < n; ++i)
      series.gyro_dps[i] += clipped(series.rate_ref_dps[i]) - series.rate_ref_dps[i];
  }

 private:
  double clipped(double z) const {
    const double limit = z < 0.0 && below_dps > 0.0 ? below_dps : limit_dps;
    const double bent_dps = knee * limit, beyond_dps = std::abs(z) - limit;
    if (beyond_dps >= bent_dps) return std::copysign(limit, z);
    if (!(beyond_dps > -bent_dps)) return z;
    const double into_dps = beyond_dps + bent_dps;
    return z - std::copysign(into_dps * into_dps / (4.0 * bent_dps), z);
  }
};

}  // namespace gyrostat::effects
