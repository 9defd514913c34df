#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The sensor gives angles on a grid of steps sqrt(12) Q, and the rate is their difference: it
/// carries (e_i - e_{i-1}) / interval with white errors e, uniform over a step, of standard
/// deviation Q (IEEE Std 952 annex C, quantization noise). At even intervals its autocovariance is
/// 2 (Q / interval)^2 at lag 0, half of that and negative at lag 1, 0 beyond; its Allan variance is
/// 3 Q^2 / tau^2.
struct AngleQuantization {
  double coefficient_deg = 2e-4;

  static constexpr std::string_view title = "the angle lies on a grid";
  static constexpr Stage stage = Stage::noise;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = AngleQuantization;
    return std::array{
        Field{"coefficient_deg", &P::coefficient_deg, "deg", ranges::non_negative,
              "Q, standard deviation of the angle's error"},
    };
  }

  static constexpr AngleQuantization absent() { return {.coefficient_deg = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    const std::size_t n = samples_with(series, needs);
    if (n < 2) return;
    const auto error = noise.stream("angle_quantization");
    const double step_deg = std::sqrt(12.0) * coefficient_deg;
    double before_deg = step_deg * (error.uniform(0) - 0.5);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t to = std::max<std::size_t>(i, 1);
      const double error_deg = step_deg * (error.uniform(i + 1) - 0.5);
      series.gyro_dps[i] += (error_deg - before_deg) / (series.t_s[to] - series.t_s[to - 1]);
      before_deg = error_deg;
    }
  }
};

}  // namespace gyrostat::effects
