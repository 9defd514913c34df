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
/// 3 Q^2 / tau^2. On the grid, it is the angle that is rounded: so are the errors where a step is
/// not much more than what noise turns it by in an interval, and rates are multiples of a step an
/// interval.
struct AngleQuantization {
  double coefficient_deg = 2e-4;
  double on_grid = 0.0;

  static constexpr std::string_view title = "the angle lies on a grid";
  static constexpr Stage stage = Stage::conversion;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = AngleQuantization;
    return std::array{
        Field{"coefficient_deg", &P::coefficient_deg, "deg", ranges::non_negative,
              "Q, standard deviation of the angle's error"},
        Field{"on_grid", &P::on_grid, "1", Range{.from = 0, .to = 1, .whole = true},
              "1: the angle is rounded, 0: its errors know nothing of it"},
    };
  }

  static constexpr AngleQuantization absent() { return {.coefficient_deg = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    const std::size_t n = samples_with(series, needs);
    if (n < 2) return;
    const auto chance = noise.stream("angle_quantization");
    const double step_deg = std::sqrt(12.0) * coefficient_deg;
    if (on_grid > 0.5 && step_deg > 0.0)
      round_angle(series, n, step_deg, chance.uniform(0));
    else
      add_errors(series, n, step_deg, chance);
  }

 private:
  static void add_errors(Series& series, std::size_t n, double step_deg, const auto& chance) {
    double before_deg = step_deg * (chance.uniform(0) - 0.5);
    for (std::size_t i = 0; i < n; ++i) {
      const double error_deg = step_deg * (chance.uniform(i + 1) - 0.5);
      series.gyro_dps[i] += (error_deg - before_deg) / interval_s(series, i);
      before_deg = error_deg;
    }
  }

  /// In steps, from a place between two of them that nobody knows.
  static void round_angle(Series& series, std::size_t n, double step_deg, double place) {
    double angle = place, before = std::floor(angle);
    for (std::size_t i = 0; i < n; ++i) {
      const double steps_per_dps = interval_s(series, i) / step_deg;
      angle += series.gyro_dps[i] * steps_per_dps;
      const double now = std::floor(angle);
      series.gyro_dps[i] = (now - before) / steps_per_dps;
      before = now;
    }
  }

  /// That before a sample; the mean of an even series, whose grid is then the same throughout.
  static double interval_s(const Series& series, std::size_t i) {
    const std::size_t to = std::max<std::size_t>(i, 1);
    const double own = series.t_s[to] - series.t_s[to - 1];
    const double mean =
        (series.t_s.back() - series.t_s.front()) / static_cast<double>(series.t_s.size() - 1);
    return std::abs(own - mean) < 1e-6 * mean ? mean : own;
  }
};

}  // namespace gyrostat::effects
