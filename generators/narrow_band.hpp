#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gyrostat/core/random.hpp>
#include <gyrostat/generators/sampled.hpp>

namespace gyrostat {

/// A stationary normal process of unit variance about a centre: a carrier whose two quadratures are
/// Gauss-Markov processes. Its autocorrelation is exp(-pi bandwidth lag) cos(2 pi centre lag), its
/// density a Lorentzian, `bandwidth` wide between the points of half power. Exact between samples,
/// even or not.
class NarrowBand {
 public:
  NarrowBand(double centre_hz, double bandwidth_hz, const NormalStream& in_phase,
             const NormalStream& quadrature)
      : centre_hz_(centre_hz),
        decay_(1.0 / (std::numbers::pi * bandwidth_hz)),
        in_phase_(in_phase),
        quadrature_(quadrature) {}

  /// Its value at sample i, one sample after the other.
  double operator()(const std::vector<double>& t_s, std::size_t i) {
    const double interval_s = i == 0 ? 0.0 : t_s[i] - t_s[i - 1];
    const double a = decay_(t_s, i);
    if (std::abs(interval_s - known_s_) > 1e-6 * interval_s) {
      known_s_ = interval_s;
      rotation_ = std::polar(a, 2.0 * std::numbers::pi * centre_hz_ * interval_s);
      drive_ = std::sqrt((1.0 - a) * (1.0 + a));
    }
    // Written out, since complex multiplication checks for NaN.
    const double real = rotation_.real() * state_.real() - rotation_.imag() * state_.imag();
    const double imag = rotation_.real() * state_.imag() + rotation_.imag() * state_.real();
    state_ = {real + drive_ * in_phase_.next(), imag + drive_ * quadrature_.next()};
    return state_.real();
  }

 private:
  double centre_hz_;
  Decay decay_;
  Deviates in_phase_, quadrature_;
  std::complex<double> state_, rotation_;
  double known_s_ = -1.0, drive_ = 1.0;
};

}  // namespace gyrostat
