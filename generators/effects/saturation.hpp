#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The output is clipped at the limits of the input range (IEEE Std 528, input range), or the
/// sensing element is: then what comes after it, bias and noise, goes on beyond.
struct Saturation {
  double limit_dps = 50.0;
  double of_element = 0.0;

  static constexpr std::string_view title = "the output is clipped";
  static constexpr Stage stage = Stage::conversion;
  static constexpr bool sample_by_sample = true;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = Saturation;
    return std::array{
        Field{"limit_dps", &P::limit_dps, "dps", ranges::positive, "largest output"},
        Field{"of_element", &P::of_element, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: the rate is clipped, and noise comes after; 0: the output is"},
    };
  }

  static constexpr Saturation absent() { return {.limit_dps = 1e9}; }

  bool is_response() const { return of_element >= 0.5; }

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
    return z > limit_dps ? limit_dps : z < -limit_dps ? -limit_dps : z;
  }
};

}  // namespace gyrostat::effects
