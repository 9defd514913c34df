#pragma once

#include <memory>

#include <gyrostat/generators/environment/motion/list.hpp>
#include <gyrostat/generators/environment/temperature/list.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

constexpr double ten_minutes_s = 600.0, twenty_minutes_s = 1200.0;

/// One and a half cycles of temperature.
inline Scenario still(double duration_s = twenty_minutes_s) {
  Scenario s;
  s.sampling = {duration_s, 20.0};
  s.random_error = {
      .phi = 0.8, .delta1_dps = 3e-4, .delta2_dps = 2.8e-4, .measurement_noise_std_dps = 0.05};
  s.thermal_drift = {.a_dps_per_C = -0.002, .b_dps_s_per_C = 0.1, .c_dps = 0.1};
  s.temperature = temperature::Cycle{23.0, 57.0, duration_s / 1.5};
  s.compass.noise_std_deg = 0.3;
  return s;
}

inline Scenario moving(double duration_s = twenty_minutes_s) {
  Scenario s = still(duration_s);
  s.temperature = temperature::QuietRoom{.start_C = 38.0, .end_C = 40.0};
  s.motion = motion::Sinusoidal{80.0, 0.031};
  return s;
}

/// So many samples of a motion at 25 Hz, of a rate that is a function of time.
template <class Rate>
motion::Recorded turned_at_25_hz(int samples, const Rate& rate_dps) {
  const auto turns = std::make_shared<Series>();
  for (int i = 0; i < samples; ++i) {
    turns->t_s.push_back(0.04 * i);
    turns->rate_ref_dps.push_back(rate_dps(0.04 * i));
  }
  return motion::Recorded{turns};
}

/// What a recorder would keep of a simulated signal.
inline Series recorded(const Scenario& scenario, std::uint64_t seed, bool with_rate) {
  Series s;
  synthesise(scenario, {seed, 0}, s);
  s.thermal_bias_dps.clear();
  s.random_error_dps.clear();
  s.mag_valid.clear();
  if (!with_rate) s.rate_ref_dps.clear();
  return s;
}

}  // namespace gyrostat::gap
