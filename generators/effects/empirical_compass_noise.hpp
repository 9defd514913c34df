#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/all_pole.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// A compass whose noise is an autoregression: what a recording shows where no cause is known. It
/// is not in the catalogue, and is never named as one.
struct EmpiricalCompassNoise {
  double innovation_std_deg = 0.3;
  double reflection_1 = -0.3, reflection_2 = 0.0, reflection_3 = 0.0, reflection_4 = 0.0;
  double wander_std_deg = 0.0, wander_time_s = 60.0;
  double tail = 0.0;

  static constexpr std::string_view title = "the compass noise has a colour without a name";
  static constexpr Stage stage = Stage::compass;
  static constexpr std::array needs = {&Series::heading_deg};

  static constexpr auto fields() {
    using P = EmpiricalCompassNoise;
    constexpr Range stable{.from = -1, .to = 1};
    constexpr auto& of_order = "reflection coefficient of the autoregression";
    return std::array{
        Field{"innovation_std_deg", &P::innovation_std_deg, "deg", ranges::non_negative,
              "standard deviation of the white noise that drives it"},
        Field{"reflection_1", &P::reflection_1, "1", stable, of_order},
        Field{"reflection_2", &P::reflection_2, "1", stable, of_order},
        Field{"reflection_3", &P::reflection_3, "1", stable, of_order},
        Field{"reflection_4", &P::reflection_4, "1", stable, of_order},
        Field{"wander_std_deg", &P::wander_std_deg, "deg", ranges::non_negative,
              "standard deviation of a Gauss-Markov wander beside it"},
        Field{"wander_time_s", &P::wander_time_s, "s", ranges::positive,
              "correlation time of the wander"},
        Field{"tail", &P::tail, "1", ranges::fraction,
              "heaviness h of the tails of what drives it: sinh(h n) of a normal n; 0: normal"},
    };
  }

  static constexpr std::size_t order = 4;
  static constexpr EmpiricalCompassNoise absent() { return {.innovation_std_deg = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    Deviates white(noise.stream("empirical_compass_noise"));
    AllPole<order> coloured({reflection_1, reflection_2, reflection_3, reflection_4});
    // Of unit variance: E sinh²(h n) = (exp(2 h²) - 1) / 2 (after Jones and Pewsey, Biometrika 96,
    // 2009, who name the family sinh-arcsinh).
    const double scale = tail > 0.0 ? 1.0 / std::sqrt(0.5 * std::expm1(2.0 * tail * tail)) : 1.0;
    for (double& heading : series.heading_deg) {
      const double normal = white.next();
      const double driven = tail > 0.0 ? scale * std::sinh(tail * normal) : normal;
      heading += coloured(innovation_std_deg * driven);
    }
    if (wander_std_deg == 0.0) return;
    Deviates drive(noise.stream("empirical_compass_noise/wander"));
    Decay decay(wander_time_s);
    double wander_deg = wander_std_deg * drive.next();
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      if (i > 0) {
        const double kept = decay.over(series.t_s[i] - series.t_s[i - 1]);
        wander_deg =
            kept * wander_deg + wander_std_deg * std::sqrt(1.0 - kept * kept) * drive.next();
      }
      series.heading_deg[i] += wander_deg;
    }
  }
};

}  // namespace gyrostat::effects
