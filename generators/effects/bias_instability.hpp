#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "generators/effects/gauss_markov.hpp"
#include "core/fields.hpp"
#include "core/random.hpp"
#include "core/series.hpp"
#include "generators/stage.hpp"

namespace gyrostat::effects {

/// Flicker rate noise, density B^2 / (2 pi f), so that the Allan deviation has its floor at
/// sqrt(2 ln 2 / pi) B (IEEE Std 952 annex C). It is a sum of Gauss-Markov processes, one an octave
/// of correlation time from two samples to twice the signal, whose Lorentzians of equal variance
/// B^2 ln 2 / pi add up to 1/f (van der Ziel, Physica 16, 1950).
struct BiasInstability {
  double coefficient_dps = 0.002;

  static constexpr std::string_view title = "1/f noise";
  static constexpr Stage stage = Stage::electronics;

  static constexpr auto fields() {
    using P = BiasInstability;
    return std::array{
        Field{"coefficient_dps", &P::coefficient_dps, "dps", ranges::non_negative,
              "B, bias instability coefficient"},
    };
  }

  static constexpr BiasInstability absent() { return {.coefficient_dps = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    if (coefficient_dps == 0.0 || series.size() < 2) return;
    const double interval_s = series.duration_s() / static_cast<double>(series.size() - 1);
    const double std_dps = coefficient_dps * std::sqrt(std::numbers::ln2 / std::numbers::pi);
    for (double octave = 1.0; octave <= 2.0 * static_cast<double>(series.size()); octave *= 2.0)
      GaussMarkov{.std_dps = std_dps, .correlation_time_s = 2.0 * octave * interval_s}.add_to(
          series, noise.stream("bias_instability/" + std::to_string(static_cast<long>(octave))));
  }
};

}  // namespace gyrostat::effects
