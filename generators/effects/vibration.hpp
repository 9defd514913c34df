#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/narrow_band.hpp>
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
    NarrowBand line(centre_hz, bandwidth_hz, noise.stream("vibration/in_phase"),
                    noise.stream("vibration/quadrature"));
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] += std_dps * line(series.t_s, i);
  }
};

}  // namespace gyrostat::effects
