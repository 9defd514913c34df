#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Flicker rate noise, two-sided density B^2 / (2 pi f), so that the Allan deviation has its floor
/// at sqrt(2 ln 2 / pi) B (IEEE Std 952 annex C, bias instability). It is a sum of Gauss-Markov
/// processes, one every second octave of correlation time from one sampling interval to four times
/// the signal, whose Lorentzians of equal variance 2 B^2 ln 2 / pi add up to 1/f within 0.4 %
/// (van der Ziel, Physica 16, 1950); or from a longer time on, above which frequency it falls as
/// 1/f^2, as a sensor's output filter or another simulator has it. One that is more
/// than sixteen times as slow as the fastest is drawn as seldom, and is linear between.
struct BiasInstability {
  double coefficient_dps = 0.002;
  double shortest_s = 0.0;

  static constexpr std::string_view title = "1/f noise";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = BiasInstability;
    return std::array{
        Field{"coefficient_dps", &P::coefficient_dps, "dps", ranges::non_negative,
              "B, bias instability coefficient"},
        Field{"shortest_s", &P::shortest_s, "s", ranges::non_negative,
              "shortest correlation time; 0: a sampling interval"},
    };
  }

  static constexpr BiasInstability absent() { return {.coefficient_dps = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    const std::size_t n = samples_with(series, needs);
    if (n < 2) return;
    const auto intervals = static_cast<double>(n - 1);
    const double interval_s = series.duration_s() / intervals;
    const double std_dps = coefficient_dps * std::sqrt(2.0 * std::numbers::ln2 / std::numbers::pi);
    const double shortest = std::max(1.0, shortest_s / interval_s);
    for (double memory = shortest; memory <= 4.0 * intervals; memory *= 4.0) {
      Deviates white(noise.stream("bias_instability/" + std::to_string(std::ilogb(memory))));
      // Samples from one draw to the next.
      const double knots_each = std::max(1.0, memory / shortest / 16.0);
      const double knot_s = knots_each * interval_s, decay = std::exp(-knots_each / memory);
      const double drive = std::sqrt((1.0 - decay) * (1.0 + decay));
      double from = white.next(), to = decay * from + drive * white.next(), knots = 1.0;
      for (std::size_t i = 0; i < n; ++i) {
        const double at = (series.t_s[i] - series.t_s[0]) / knot_s;
        for (; at > knots; ++knots) {
          from = to;
          to = decay * to + drive * white.next();
        }
        series.gyro_dps[i] += std_dps * (to - (knots - at) * (to - from));
      }
    }
  }
};

}  // namespace gyrostat::effects
