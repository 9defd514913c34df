#pragma once

#include <vector>

#include "core/models/arima111.hpp"
#include "core/models/thermal.hpp"
#include "generators/effects/list.hpp"
#include "generators/environment/magnetic/compass.hpp"
#include "generators/environment/motion/list.hpp"
#include "generators/environment/temperature/list.hpp"

namespace gyrostat {

/// How long and how fast a gyro is sampled.
struct Sampling {
  double duration_s = 60.0;
  double rate_hz = 100.0;

  static constexpr auto fields() {
    using P = Sampling;
    return std::array{
        Field{"duration_s", &P::duration_s, "s", Range{.from = 0, .to = 1e7, .open_from = true}, "length of the signal"},
        Field{"rate_hz", &P::rate_hz, "Hz", Range{.from = 0, .to = 1e6, .open_from = true}, "sampling rate"},
    };
  }

  std::size_t samples() const;
};

/// Everything that a simulated gyro signal depends on, besides its noise.
struct Scenario {
  Sampling sampling;
  Arima111<double> random_error;
  ThermalDrift<double> thermal_drift;
  Temperatures::Any temperature = temperature::QuietRoom{};
  Motions::Any motion = motion::Stationary{};
  Compass compass;
  std::vector<Effects::Any> effects;
};

/// The signal of `scenario` under `noise`, with its truth, into `series` (whose memory is reused):
///   gyro = rate_ref + thermal_bias + random_error + white noise,
/// altered by each effect at its stage. T' of the linear drift is the derivative between samples.
void synthesise(const Scenario& scenario, const Noise& noise, Series& series);

/// The same errors under the conditions of a recording: its times, temperature, reference rate (0
/// where absent), acceleration and compass flags take the place of the scenario's own sampling,
/// profiles and disturbance flags.
void synthesise_under(const Scenario& scenario, const Series& conditions, const Noise& noise,
                      Series& series);

}  // namespace gyrostat
