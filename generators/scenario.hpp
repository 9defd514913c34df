#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include <gyrostat/core/models/arima111.hpp>
#include <gyrostat/core/models/thermal_drift.hpp>
#include <gyrostat/generators/effect.hpp>
#include <gyrostat/generators/environment/magnetic/compass.hpp>
#include <gyrostat/generators/profile.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat {

/// How long and how fast a gyro is sampled.
struct Sampling {
  double duration_s = 60.0;
  double rate_hz = 100.0;

  static constexpr auto fields() {
    using P = Sampling;
    return std::array{
        Field{"duration_s", &P::duration_s, "s", Range{.from = 0, .to = 1e7, .open_from = true},
              "length of the signal"},
        Field{"rate_hz", &P::rate_hz, "Hz", Range{.from = 0, .to = 1e6, .open_from = true},
              "sampling rate"},
    };
  }

  std::size_t samples() const;
};

/// Everything that a simulated gyro signal depends on, besides its noise.
///
/// Example: a minute of a gyro that drifts with temperature and is quantised.
///
///   #include <gyrostat/generators/effects/quantization.hpp>
///
///   Scenario scenario;
///   scenario.sampling = {.duration_s = 60, .rate_hz = 100};
///   scenario.random_error = {.phi = 0.5, .delta1_dps = 2e-4, .delta2_dps = 1e-4};
///   scenario.thermal_drift = {.a_dps_per_C = 0.002};
///   scenario.effects.emplace_back(effects::Quantization{.lsb_dps = 0.01});
struct Scenario {
  Sampling sampling;
  Arima111<double> random_error;
  ThermalDrift<double> thermal_drift;
  Temperature temperature{temperature_types().named("quiet_room", "scenario")};
  Motion motion{motion_types().named("stationary", "scenario")};
  /// About the two other axes; none: nothing tells that rate, its channel is empty.
  std::optional<Motion> cross_motion_1, cross_motion_2;
  std::optional<Acceleration> acceleration;  ///< none: no accelerometer, acc channels empty
  Compass compass;
  std::vector<Effect> effects;
  /// What a real sensor recorded at rest, sample by sample; stands in place of the random error and
  /// the white noise, its mean being the former. As long as the signal, or longer.
  std::shared_ptr<const std::vector<double>> recorded_noise_dps;
};

/// The signal of `scenario` under `noise`, with its truth, into `series` (whose memory is reused):
///   gyro = rate_ref + thermal_bias + random_error + white noise (or recorded noise),
/// altered by each effect at its stage. T' of the linear drift is the derivative between samples;
/// of a recorded temperature, which has steps, it is the change over ten seconds [B eq. 5].
///
/// Example: the signal of trial 17, as any other program makes it from the same seed.
///
///   Series series;
///   synthesise(Scenario{}, {.seed = 1, .trial = 17}, series);
///
/// Thread safety: may run in any number of threads at once, each with a `series` of its own; a
/// scenario is only read.
void synthesise(const Scenario& scenario, const Noise& noise, Series& series);

/// What of it comes before any gyro or compass: its times, temperature, rates, acceleration and
/// thermal drift.
void synthesise_conditions(const Scenario& scenario, const Noise& noise, Series& series);

/// And onto it what comes before the compass's noise: the heading as it turns, not wrapped, with
/// the effects on it.
void turn_compass(const Scenario& scenario, const Noise& noise, Series& series);

/// What happens to a rate after its white noise, in order: to the noise, then how the rate is
/// sensed, then all else, stage by stage.
std::vector<Effect> effects_on_gyro(const Scenario& scenario);

/// Has them act on the gyro. To what comes after an effect that says how the rate is sensed, that
/// is the rate; afterwards `rate_ref_dps` is the true one again.
void apply_in_order(const std::vector<Effect>& on_gyro, const Noise& noise, Series& series);

/// The errors of `scenario` under the conditions of a recording: its times, even or not,
/// temperature, rates (about its own axis 0 where it has none), acceleration, mag_valid, and its
/// gaps in gyro and heading. The scenario's sampling, profiles, effects on the environment and
/// magnetic disturbances play no part. Missing temperatures, rates and accelerations are held while
/// errors are computed from them; without temperature the drift is c alone. `series` is another
/// than `conditions`.
void synthesise_under(const Scenario& scenario, const Series& conditions, const Noise& noise,
                      Series& series);

/// Into `series`, which has nothing else then, what of the conditions a gyro's errors are computed
/// from, held where it is missing.
void hold_influences(const Series& conditions, Series& series);

/// Its gyro alone, and its heading alone: the same bits.
void synthesise_rate_under(const Scenario& scenario, const Series& conditions, const Noise& noise,
                           Series& series);
void synthesise_heading_under(const Scenario& scenario, const Series& conditions,
                              const Noise& noise, Series& series);

}  // namespace gyrostat
