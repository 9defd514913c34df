#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/fast_part.hpp>
#include <gyrostat/generators/linear_spline.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// All fast errors of the rate grow or shrink with how fast the sensor turns: by gain_k where the
/// true rate is of size fastest / 3^(8 - k), on a straight line over the rate's logarithm between,
/// and by the first and the last gain beyond (a linear spline; de Boor, "A Practical Guide to
/// Splines", 1978). It is not in the catalogue, and is never named as a cause.
struct EmpiricalNoiseOverRate {
  double fastest_dps = 100.0;
  double gain_1 = 1.0, gain_2 = 1.0, gain_3 = 1.0, gain_4 = 1.0, gain_5 = 1.0, gain_6 = 1.0,
         gain_7 = 1.5, gain_8 = 2.0;

  static constexpr std::string_view title = "fast errors depend on the rate, without a name";
  static constexpr Stage stage = Stage::conversion;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps,
                                       &Series::thermal_bias_dps, &Series::random_error_dps};

  static constexpr auto fields() {
    using P = EmpiricalNoiseOverRate;
    constexpr auto& gain = "of fast errors, at its rate";
    return std::array{
        Field{"fastest_dps", &P::fastest_dps, "dps", ranges::positive, "rate of the last gain"},
        Field{"gain_1", &P::gain_1, "1", ranges::non_negative, gain},
        Field{"gain_2", &P::gain_2, "1", ranges::non_negative, gain},
        Field{"gain_3", &P::gain_3, "1", ranges::non_negative, gain},
        Field{"gain_4", &P::gain_4, "1", ranges::non_negative, gain},
        Field{"gain_5", &P::gain_5, "1", ranges::non_negative, gain},
        Field{"gain_6", &P::gain_6, "1", ranges::non_negative, gain},
        Field{"gain_7", &P::gain_7, "1", ranges::non_negative, gain},
        Field{"gain_8", &P::gain_8, "1", ranges::non_negative, gain},
    };
  }

  static constexpr std::size_t knots = 8;
  static constexpr double ratio = 3.0;  ///< of one knot's rate to that before it
  static constexpr EmpiricalNoiseOverRate absent() { return {.gain_7 = 1.0, .gain_8 = 1.0}; }

  /// Where between the knots a rate lies, from 0 at the first to 7 at the last.
  static double place_of(double rate_dps, double fastest_dps) {
    constexpr double last = knots - 1;
    const double size = std::max(std::abs(rate_dps) / fastest_dps, 1e-12);
    return std::clamp(last + std::log(size) / std::log(ratio), 0.0, last);
  }

  void apply(Series& series, const Noise& /*noise*/) const {
    const std::array gains{gain_1, gain_2, gain_3, gain_4, gain_5, gain_6, gain_7, gain_8};
    FastPart part;
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double rate = series.rate_ref_dps[i];
      const double fast = part(series.t_s, i, error_beside_drift(series, i));
      const double place = std::isfinite(rate) ? place_of(rate, fastest_dps) : 0.0;
      series.gyro_dps[i] += (between_knots(gains, place) - 1.0) * fast;
    }
  }
};

}  // namespace gyrostat::effects
