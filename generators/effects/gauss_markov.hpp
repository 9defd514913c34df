#pragma once

#include <array>
#include <cmath>
#include <limits>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Exponentially correlated rate noise (IEEE Std 952 annex C): stationary, variance std^2,
/// autocorrelation exp(-lag / T), exact between samples. That of second order has a slope, too, and
/// is smooth: its autocorrelation is (1 + lag / T) exp(-lag / T) (Gelb, "Applied Optimal
/// Estimation", 1974, 2.2). T is such that the autocorrelation is 1/e at the correlation time.
struct GaussMarkov {
  double std_dps = 0.005;
  double correlation_time_s = 100.0;
  double order = 1.0;

  static constexpr std::string_view title = "exponentially correlated noise";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = GaussMarkov;
    return std::array{
        Field{"std_dps", &P::std_dps, "dps", ranges::non_negative, "standard deviation"},
        Field{"correlation_time_s", &P::correlation_time_s, "s", ranges::positive,
              "lag at which the autocorrelation is 1/e"},
        Field{"order", &P::order, "1", Range{.from = 1, .to = 2, .whole = true},
              "of the process: 2 is smooth"},
    };
  }

  static constexpr GaussMarkov absent() { return {.std_dps = 0.0}; }

  bool is_of_second_order() const { return order > 1.5; }
  /// T.
  double time_constant_s() const {
    constexpr double of_second_order = 2.1461932206205825;  // (1 + x) exp(-x) = 1 / e
    return correlation_time_s / (is_of_second_order() ? of_second_order : 1.0);
  }

  void apply(Series& series, const Noise& noise) const {
    if (is_of_second_order()) return add_smooth(series, noise);
    Deviates white(noise.stream("gauss_markov"));
    Decay decay(correlation_time_s);
    double state = 0.0;
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double a = decay(series.t_s, i);
      state = a * state + std::sqrt((1.0 - a) * (1.0 + a)) * white.next();
      series.gyro_dps[i] += std_dps * state;
    }
  }

 private:
  /// The process and its slope times T are independent at any time and vary alike: with u the
  /// interval over T, what is left of them is exp(-u) [1 + u, u; -u, 1 - u], and the rest is new.
  struct Step {
    double interval_s = std::numeric_limits<double>::quiet_NaN();
    double left = 0.0, u = 0.0, new_value = 1.0, new_both = 0.0, new_slope = 1.0;

    Step() = default;
    Step(double interval, double time_constant_s)
        : interval_s(interval),
          left(std::exp(-interval / time_constant_s)),
          u(interval / time_constant_s) {
      // exp(2 u) - 1 - 2 u - 2 u^2, of which little is left where u is small.
      double rest = 0.0, term = 2.0 * u;
      for (int k = 2; k < 40; ++k) {
        term *= 2.0 * u / k;
        if (k > 2) rest += term;
      }
      const double square = left * left;
      const double value = u < 1.0 ? square * rest : 1.0 - square * (1.0 + 2.0 * u + 2.0 * u * u);
      const double slope = -std::expm1(-2.0 * u) + square * (2.0 * u - 2.0 * u * u);
      new_value = std::sqrt(std::max(value, 0.0));
      new_both = new_value > 0.0 ? 2.0 * u * u * square / new_value : 0.0;
      new_slope = std::sqrt(std::max(slope - new_both * new_both, 0.0));
    }
  };

  void add_smooth(Series& series, const Noise& noise) const {
    Deviates of_value(noise.stream("gauss_markov")), of_slope(noise.stream("gauss_markov/slope"));
    Step step;
    double value = 0.0, slope = 0.0;
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      if (i > 0)
        if (const double interval_s = series.t_s[i] - series.t_s[i - 1];
            !(std::abs(interval_s - step.interval_s) <= 1e-6 * step.interval_s))
          step = Step(interval_s, time_constant_s());
      const double first = of_value.next(), second = of_slope.next();
      const double kept = value + step.u * (value + slope),
                   turned = slope - step.u * (value + slope);
      value = step.left * kept + step.new_value * first;
      slope = step.left * turned + step.new_both * first + step.new_slope * second;
      series.gyro_dps[i] += std_dps * value;
    }
  }
};

}  // namespace gyrostat::effects
