#include <gyrostat/generators/scenario.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

#include <gyrostat/generators/effects/time_offset.hpp>
#include <gyrostat/generators/environment/temperature/recorded.hpp>
#include <gyrostat/generators/random_error.hpp>

namespace gyrostat {
namespace {

/// That of one of several effects: two of a kind do not share theirs.
Noise own_noise(const std::vector<Effect>& effects, const Effect& of, Noise noise) {
  for (const Effect* other = effects.data(); other != &of; ++other)
    if (other->id() == of.id()) ++noise.twins;
  return noise;
}

void apply_stage(Stage stage, const Scenario& scenario, const Noise& noise, Series& series) {
  for (const auto& effect : scenario.effects)
    if (effect.stage() == stage) effect.apply(series, own_noise(scenario.effects, effect, noise));
}

/// T' is the change between samples; of a recorded temperature, which has steps that would make
/// spikes of it, that over ten seconds [B eq. 5].
void linear_drift(const ThermalDrift<double>& drift, bool is_recorded, Series& series) {
  const auto& T = series.temperature_C;
  if (T.empty()) {
    series.thermal_bias_dps.assign(series.size(), drift.c_dps);
    return;
  }
  constexpr double half_s = 5.0;
  const auto& t = series.t_s;
  const std::size_t last = series.size() - 1;
  series.thermal_bias_dps.resize(series.size());
  for (std::size_t i = 0, from = 0, to = std::min<std::size_t>(1, last); i <= last; ++i) {
    if (is_recorded) {
      while (t[from] < t[i] - half_s) ++from;
      while (to < last && t[to] < t[i] + half_s) ++to;
    } else if (i > 0) {
      from = i - 1;
      to = i;
    }
    const double slope = from == to ? 0.0 : (T[to] - T[from]) / (t[to] - t[from]);
    series.thermal_bias_dps[i] =
        drift.a_dps_per_C * T[i] + drift.b_dps_s_per_C * slope + drift.c_dps;
  }
}

/// Random error and white noise onto what `series.gyro_dps` has.
void add_noise(const Scenario& scenario, const Noise& noise, Series& series) {
  series.random_error_dps.assign(series.size(), 0.0);
  if (const auto& recorded = scenario.recorded_noise_dps) {
    assert(recorded->size() >= series.size());
    const double sum = std::accumulate(recorded->begin(), recorded->end(), 0.0);
    series.random_error_dps.assign(series.size(), sum / static_cast<double>(recorded->size()));
    for (std::size_t i = 0; i < series.size(); ++i) series.gyro_dps[i] += (*recorded)[i];
    return;
  }
  add_random_error(scenario.random_error, noise, series.random_error_dps);
  for (std::size_t i = 0; i < series.size(); ++i) series.gyro_dps[i] += series.random_error_dps[i];
  add_white_noise(scenario.random_error.measurement_noise_std_dps, noise.stream("white_noise"),
                  series.gyro_dps);
}

void drift(const Scenario& scenario, bool is_recorded, const Noise& noise, Series& series) {
  linear_drift(scenario.thermal_drift, is_recorded, series);
  apply_stage(Stage::sensing, scenario, noise, series);
}

/// From the conditions in `series`, drift included, to its gyro.
void measure_rate(const Scenario& scenario, const Noise& noise, Series& series) {
  series.gyro_dps.resize(series.size());
  for (std::size_t i = 0; i < series.size(); ++i)
    series.gyro_dps[i] = series.rate_ref_dps[i] + series.thermal_bias_dps[i];
  add_noise(scenario, noise, series);
  apply_in_order(effects_on_gyro(scenario), noise, series);
}

void turn(const Compass& compass, const Scenario& scenario, const Noise& noise, Series& series) {
  compass.turn(series);
  for (const auto& effect : scenario.effects)
    if (const auto* clock = effect.as<effects::TimeOffset>()) clock->show_heading(series);
  apply_stage(Stage::compass, scenario, noise, series);
}

void measure_heading(const Compass& compass, const Scenario& scenario, const Noise& noise,
                     Series& series) {
  turn(compass, scenario, noise, series);
  compass.read(series, noise);
}

template <class Type, std::size_t Width>
void follow(const Chosen<Type>& profile, Series& series,
            const std::array<std::vector<double> Series::*, Width>& channels_of) {
  std::array<std::span<double>, Width> values;
  for (std::size_t k = 0; k < Width; ++k) {
    auto& channel = series.*channels_of[k];
    channel.resize(series.size());
    values[k] = channel;
  }
  profile.type().at(profile.plugin(), series.t_s, values);
}

/// `from` with each missing sample replaced by the one before it, or by the first that there is.
/// Empty if there is none.
void copy_without_gaps(const std::vector<double>& from, std::vector<double>& to) {
  const auto is_there = [](double value) { return !std::isnan(value); };
  const auto first = std::find_if(from.begin(), from.end(), is_there);
  if (first == from.end()) return to.clear();
  to = from;
  double last = *first;
  for (double& value : to) last = value = is_there(value) ? value : last;
}

void copy_gaps(const std::vector<double>& from, std::vector<double>& to) {
  for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i)
    if (std::isnan(from[i])) to[i] = no_value;
}

/// The channels of a recording that errors are computed from.
constexpr std::array influences = {&Series::temperature_C,   &Series::rate_ref_dps,
                                   &Series::acc_x_mps2,      &Series::acc_y_mps2,
                                   &Series::acc_z_mps2,      &Series::cross_rate_1_dps,
                                   &Series::cross_rate_2_dps};

}  // namespace

std::vector<Effect> effects_on_gyro(const Scenario& scenario) {
  std::vector<Effect> ordered;
  const auto take = [&](Stage stage, Response response) {
    for (const auto& effect : scenario.effects)
      if (effect.stage() == stage && effect.response() == response) ordered.push_back(effect);
  };
  take(Stage::noise, Response::none);
  for (const auto response : {Response::of_element, Response::of_electronics, Response::none})
    for (const auto stage : {Stage::electronics, Stage::conversion, Stage::transport})
      take(stage, response);
  return ordered;
}

void apply_in_order(const std::vector<Effect>& on_gyro, const Noise& noise, Series& series) {
  const auto responds = [](const Effect& effect) { return effect.is_response(); };
  if (std::none_of(on_gyro.begin(), on_gyro.end(), responds)) {
    for (const auto& effect : on_gyro) effect.apply(series, own_noise(on_gyro, effect, noise));
    return;
  }
  const auto reference = series.rate_ref_dps;
  for (const auto& effect : on_gyro) {
    if (!effect.is_response()) {
      effect.apply(series, own_noise(on_gyro, effect, noise));
      continue;
    }
    const auto before = series.gyro_dps;
    effect.apply(series, own_noise(on_gyro, effect, noise));
    for (std::size_t i = 0; i < std::min(before.size(), series.rate_ref_dps.size()); ++i)
      series.rate_ref_dps[i] += series.gyro_dps[i] - before[i];
  }
  series.rate_ref_dps = reference;
}

std::size_t Sampling::samples() const {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(duration_s * rate_hz)));
}

void synthesise_conditions(const Scenario& scenario, const Noise& noise, Series& series) {
  const std::size_t samples = scenario.sampling.samples();
  series.clear();
  series.t_s.resize(samples);
  for (std::size_t i = 0; i < samples; ++i)
    series.t_s[i] = static_cast<double>(i) / scenario.sampling.rate_hz;

  follow(scenario.temperature, series, std::array{&Series::temperature_C});
  follow(scenario.motion, series, std::array{&Series::rate_ref_dps});
  if (scenario.cross_motion_1)
    follow(*scenario.cross_motion_1, series, std::array{&Series::cross_rate_1_dps});
  if (scenario.cross_motion_2)
    follow(*scenario.cross_motion_2, series, std::array{&Series::cross_rate_2_dps});
  if (scenario.acceleration)
    follow(*scenario.acceleration, series,
           std::array{&Series::acc_x_mps2, &Series::acc_y_mps2, &Series::acc_z_mps2});
  apply_stage(Stage::environment, scenario, noise, series);
  drift(scenario, scenario.temperature.as<temperature::Recorded>() != nullptr, noise, series);
}

void turn_compass(const Scenario& scenario, const Noise& noise, Series& series) {
  turn(scenario.compass, scenario, noise, series);
}

void synthesise(const Scenario& scenario, const Noise& noise, Series& series) {
  synthesise_conditions(scenario, noise, series);
  measure_rate(scenario, noise, series);
  measure_heading(scenario.compass, scenario, noise, series);
}

void hold_influences(const Series& conditions, Series& series) {
  assert(&conditions != &series);
  series.clear();
  series.t_s = conditions.t_s;
  for (const auto channel : influences) copy_without_gaps(conditions.*channel, series.*channel);
  series.rate_ref_dps.resize(series.size(), 0.0);
}

void synthesise_rate_under(const Scenario& scenario, const Series& conditions, const Noise& noise,
                           Series& series) {
  hold_influences(conditions, series);
  drift(scenario, false, noise, series);
  measure_rate(scenario, noise, series);
  copy_gaps(conditions.gyro_dps, series.gyro_dps);
  for (const auto channel : influences) copy_gaps(conditions.*channel, series.*channel);
}

void synthesise_heading_under(const Scenario& scenario, const Series& conditions,
                              const Noise& noise, Series& series) {
  assert(&conditions != &series);
  series.clear();
  series.mag_valid = conditions.mag_valid;
  if (conditions.heading_deg.empty()) return;
  series.t_s = conditions.t_s;
  copy_without_gaps(conditions.rate_ref_dps, series.rate_ref_dps);
  series.rate_ref_dps.resize(series.size(), 0.0);
  auto undisturbed = scenario.compass;
  undisturbed.disturbances.clear();
  measure_heading(undisturbed, scenario, noise, series);
  series.mag_valid = conditions.mag_valid;
  copy_gaps(conditions.heading_deg, series.heading_deg);
}

void synthesise_under(const Scenario& scenario, const Series& conditions, const Noise& noise,
                      Series& series) {
  Series heading;
  synthesise_heading_under(scenario, conditions, noise, heading);
  synthesise_rate_under(scenario, conditions, noise, series);
  series.heading_deg = std::move(heading.heading_deg);
  series.mag_valid = std::move(heading.mag_valid);
}

}  // namespace gyrostat
