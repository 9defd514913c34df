#include <gyrostat/analysis/calibration.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <gyrostat/core/error.hpp>

namespace gyrostat {
namespace {

constexpr double aiding_interval_s = 10.0;

double drift_at(const ThermalDrift<double>& drift, double temperature_C, double slope_C_per_s) {
  return drift.a_dps_per_C * temperature_C + drift.b_dps_s_per_C * slope_C_per_s + drift.c_dps;
}

double finite_or(double value, double fallback) { return std::isfinite(value) ? value : fallback; }

}  // namespace

FitMethod fit_method_named(const std::string& name, const std::string& place) {
  static const std::vector<std::string> names = {"likelihood", "moments"};
  if (name == names[0]) return FitMethod::likelihood;
  if (name == names[1]) return FitMethod::moments;
  throw InputError(place, unknown_name("fit method", name, names));
}

std::vector<double> without_drift(const Series& series, const std::optional<ThermalFit>& thermal) {
  std::vector<double> rest(series.size());
  const auto& T = series.temperature_C;
  const auto lag = static_cast<std::size_t>(std::max(1.0, aiding_interval_s * series.rate_hz()));
  for (std::size_t i = 0; i < rest.size(); ++i) {
    rest[i] = series.gyro_dps[i] - (series.rate_ref_dps.empty() ? 0.0 : series.rate_ref_dps[i]);
    if (!thermal) continue;
    const std::size_t to = std::max(i, std::min(lag, rest.size() - 1));
    const std::size_t from = to < lag ? 0 : to - lag;
    const double slope = to == from ? 0.0 : (T[to] - T[from]) / (series.t_s[to] - series.t_s[from]);
    rest[i] -= drift_at(thermal->parameters, T[i], slope);
  }
  return rest;
}

Calibration calibrate(const Series& series, FitMethod method) {
  Calibration calibration;
  if (!series.temperature_C.empty() && series.duration_s() >= 5 * aiding_interval_s) {
    calibration.thermal = fit_thermal_drift(series, aiding_interval_s);
    calibration.level_std_dps = calibration.thermal->residual_std_dps;
    calibration.start_temperature_C = series.temperature_C.front();
    calibration.bias_measurement_std_dps =
        bias_measurement_std(series, calibration.thermal->parameters, aiding_interval_s);
    calibration.compass_noise_std_deg =
        compass_noise_std(series, calibration.thermal->parameters, aiding_interval_s);
  }
  const auto rest = without_drift(series, calibration.thermal);
  calibration.random_error = fit_random_error(rest, method);
  double sum = 0.0;
  std::size_t count = 0;
  for (const double v : rest)
    if (!std::isnan(v)) {
      sum += v;
      ++count;
    }
  if (!calibration.thermal)
    calibration.mean_dps = sum / static_cast<double>(std::max<std::size_t>(count, 1));
  return calibration;
}

ParameterMap parameters_from(const Calibration& calibration, double start_temperature_C) {
  const auto& [phi, delta1, delta2, noise] = calibration.random_error.parameters;
  const auto& error = calibration.random_error.standard_errors;
  ParameterMap values = parameter_values(calibration.random_error.parameters);

  double level = calibration.mean_dps;
  if (calibration.thermal && !std::isnan(start_temperature_C))
    level = drift_at(calibration.thermal->parameters, start_temperature_C, 0.0);
  const double spread = std::max(noise, 3.0 * calibration.level_std_dps);
  values["initial_x_dps"] = values["initial_x_previous_dps"] = level;
  values["initial_x_std_dps"] = values["initial_x_previous_std_dps"] = spread;
  values["initial_phi_std"] = std::clamp(finite_or(error.phi, 0.3), 0.01, 0.3);
  values["initial_delta1_std_dps"] = std::min(finite_or(error.delta1_dps, delta1), delta1);
  values["initial_delta2_std_dps"] = std::min(finite_or(error.delta2_dps, delta1), delta1);
  values["initial_measurement_noise_std_std_dps"] =
      std::min(finite_or(error.measurement_noise_std_dps, noise), noise);

  if (!calibration.thermal) return values;
  values.merge(parameter_values(calibration.thermal->parameters));
  const auto& thermal_error = calibration.thermal->standard_errors;
  const auto& drift = calibration.thermal->parameters;
  // A regression's error does not know that the next run differs; a tenth of the value may.
  const auto widened = [](double e, double value, double least) {
    return std::max({finite_or(e, 0.0), 0.1 * std::abs(value), least});
  };
  values["initial_a_std_dps_per_C"] = widened(thermal_error.a_dps_per_C, drift.a_dps_per_C, 1e-5);
  values["initial_b_std_dps_s_per_C"] =
      widened(thermal_error.b_dps_s_per_C, drift.b_dps_s_per_C, 1e-3);
  values["initial_c_std_dps"] =
      std::max({thermal_error.c_dps, calibration.level_std_dps, 0.1 * std::abs(drift.c_dps), 1e-4});
  if (std::isfinite(calibration.bias_measurement_std_dps))
    values["bias_measurement_std_dps"] = std::max(calibration.bias_measurement_std_dps, 1e-6);
  if (std::isfinite(calibration.compass_noise_std_deg))
    values["compass_noise_std_deg"] = calibration.compass_noise_std_deg;
  return values;
}

}  // namespace gyrostat
