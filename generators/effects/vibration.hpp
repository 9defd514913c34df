#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>

#include "core/fields.hpp"
#include "core/random.hpp"
#include "core/series.hpp"
#include "generators/stage.hpp"

namespace gyrostat::effects {

/// Narrow-band random vibration: a carrier whose two quadratures are Gauss-Markov processes, so that
/// its density is a Lorentzian about the centre, `bandwidth` wide between the points of half power.
struct Vibration {
  double std_dps = 0.05;
  double centre_hz = 10.0;
  double bandwidth_hz = 1.0;

  static constexpr std::string_view title = "narrow-band random vibration";
  static constexpr Stage stage = Stage::electronics;

  static constexpr auto fields() {
    using P = Vibration;
    return std::array{
        Field{"std_dps", &P::std_dps, "dps", ranges::non_negative,
              "standard deviation"},
        Field{"centre_hz", &P::centre_hz, "Hz", ranges::positive,
              "frequency of the highest density"},
        Field{"bandwidth_hz", &P::bandwidth_hz, "Hz", ranges::positive,
              "width of the line between its half-power points"},
    };
  }

  static constexpr Vibration absent() { return {.std_dps = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    if (std_dps == 0.0 || series.size() < 2) return;
    const double interval_s = series.duration_s() / static_cast<double>(series.size() - 1);
    const double decay = std::exp(-std::numbers::pi * bandwidth_hz * interval_s);
    const std::complex<double> turn =
        std::polar(decay, 2.0 * std::numbers::pi * centre_hz * interval_s);
    const double drive = std_dps * std::sqrt(1.0 - decay * decay);
    const auto in_phase = noise.stream("vibration/in_phase");
    const auto quadrature = noise.stream("vibration/quadrature");
    std::array<double, 256> p, q;
    std::complex<double> state;
    for (std::size_t i = 0; i < series.size(); ++i) {
      if (i % p.size() == 0) {
        const std::size_t count = std::min(p.size(), series.size() - i);
        in_phase.fill(i, std::span(p).first(count));
        quadrature.fill(i, std::span(q).first(count));
      }
      const std::complex<double> drawn(p[i % p.size()], q[i % q.size()]);
      state = i == 0 ? std_dps * drawn : turn * state + drive * drawn;
      series.gyro_dps[i] += state.real();
    }
  }
};

}  // namespace gyrostat::effects
