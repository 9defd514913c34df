#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Narrow-band random vibration: a carrier whose two quadratures are Gauss-Markov processes, so
/// that its density is a Lorentzian about the centre, `bandwidth` wide between the points of half
/// power. Exact between samples, even or not.
struct Vibration {
  double std_dps = 0.05;
  double centre_hz = 10.0;
  double bandwidth_hz = 1.0;

  static constexpr std::string_view title = "narrow-band random vibration";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = Vibration;
    return std::array{
        Field{"std_dps", &P::std_dps, "dps", ranges::non_negative, "standard deviation"},
        Field{"centre_hz", &P::centre_hz, "Hz", ranges::non_negative,
              "frequency of the highest density"},
        Field{"bandwidth_hz", &P::bandwidth_hz, "Hz", ranges::positive,
              "width of the line between its half-power points"},
    };
  }

  static constexpr Vibration absent() { return {.std_dps = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    constexpr double turn = 2.0 * std::numbers::pi;
    Deviates in_phase(noise.stream("vibration/in_phase"));
    Deviates quadrature(noise.stream("vibration/quadrature"));
    Decay decay(1.0 / (std::numbers::pi * bandwidth_hz));
    std::complex<double> state, rotation;
    double known = -1.0, drive = 1.0;
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double interval_s = i == 0 ? 0.0 : series.t_s[i] - series.t_s[i - 1];
      const double a = decay(series.t_s, i);
      if (std::abs(interval_s - known) > 1e-6 * interval_s) {
        known = interval_s;
        rotation = std::polar(a, turn * centre_hz * interval_s);
        drive = std::sqrt((1.0 - a) * (1.0 + a));
      }
      // Written out, since complex multiplication checks for NaN.
      const double real = rotation.real() * state.real() - rotation.imag() * state.imag();
      const double imag = rotation.real() * state.imag() + rotation.imag() * state.real();
      state = {real + drive * in_phase.next(), imag + drive * quadrature.next()};
      series.gyro_dps[i] += std_dps * state.real();
    }
  }
};

}  // namespace gyrostat::effects
