#include "generators/scenario.hpp"

#include <algorithm>
#include <cmath>

#include "generators/random_error.hpp"

namespace gyrostat {
namespace {

void apply_stage(Stage stage, const Scenario& scenario, const Noise& noise, Series& series) {
  for (const auto& any : scenario.effects)
    std::visit([&](const auto& effect) { if (effect.stage == stage) effect.apply(series, noise); },
               any);
}

void linear_drift(const ThermalDrift<double>& drift, Series& series) {
  const auto& T = series.temperature_C;
  if (T.empty()) {
    series.thermal_bias_dps.assign(series.size(), drift.c_dps);
    return;
  }
  series.thermal_bias_dps.resize(series.size());
  for (std::size_t i = 0; i < series.size(); ++i) {
    const std::size_t from = i == 0 ? 0 : i - 1;
    const std::size_t to = i == 0 ? std::min<std::size_t>(1, series.size() - 1) : i;
    const double slope = from == to ? 0.0 : (T[to] - T[from]) / (series.t_s[to] - series.t_s[from]);
    series.thermal_bias_dps[i] =
        drift.a_dps_per_C * T[i] + drift.b_dps_s_per_C * slope + drift.c_dps;
  }
}

/// From the environment to the recording: all that the sensor and the compass add.
void add_errors(const Scenario& scenario, const Noise& noise, Series& series) {
  const std::size_t samples = series.size();
  linear_drift(scenario.thermal_drift, series);
  apply_stage(Stage::sensing, scenario, noise, series);

  series.random_error_dps.assign(samples, 0.0);
  add_random_error(scenario.random_error, noise, series.random_error_dps);
  series.gyro_dps.resize(samples);
  for (std::size_t i = 0; i < samples; ++i)
    series.gyro_dps[i] =
        series.rate_ref_dps[i] + series.thermal_bias_dps[i] + series.random_error_dps[i];
  add_white_noise(scenario.random_error.measurement_noise_std_dps, noise.stream("white_noise"),
                  series.gyro_dps);
  apply_stage(Stage::noise, scenario, noise, series);
  apply_stage(Stage::electronics, scenario, noise, series);
  apply_stage(Stage::conversion, scenario, noise, series);
  apply_stage(Stage::transport, scenario, noise, series);

  scenario.compass.observe(series, noise);
  apply_stage(Stage::compass, scenario, noise, series);
}

}  // namespace

std::size_t Sampling::samples() const {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(duration_s * rate_hz)));
}

void synthesise(const Scenario& scenario, const Noise& noise, Series& series) {
  const std::size_t samples = scenario.sampling.samples();
  series.clear();
  series.t_s.resize(samples);
  for (std::size_t i = 0; i < samples; ++i)
    series.t_s[i] = static_cast<double>(i) / scenario.sampling.rate_hz;

  const auto over_time = [&](const auto& profile, std::vector<double>& out) {
    out.resize(samples);
    std::visit([&](const auto& at) { std::transform(series.t_s.begin(), series.t_s.end(),
                                                    out.begin(), at); }, profile);
  };
  over_time(scenario.temperature, series.temperature_C);
  over_time(scenario.motion, series.rate_ref_dps);
  apply_stage(Stage::environment, scenario, noise, series);

  add_errors(scenario, noise, series);
}

void synthesise_under(const Scenario& scenario, const Series& conditions, const Noise& noise,
                      Series& series) {
  series.clear();
  series.t_s = conditions.t_s;
  series.temperature_C = conditions.temperature_C;
  series.rate_ref_dps = conditions.rate_ref_dps;
  series.rate_ref_dps.resize(series.size(), 0.0);
  series.acc_x_mps2 = conditions.acc_x_mps2;
  series.acc_y_mps2 = conditions.acc_y_mps2;
  series.acc_z_mps2 = conditions.acc_z_mps2;
  add_errors(scenario, noise, series);
  if (!conditions.mag_valid.empty()) series.mag_valid = conditions.mag_valid;
}

}  // namespace gyrostat
