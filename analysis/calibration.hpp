#pragma once

#include <optional>
#include <vector>

#include <gyrostat/analysis/fits/random_error.hpp>
#include <gyrostat/analysis/fits/thermal_regression.hpp>
#include <gyrostat/core/parameter_map.hpp>
#include <gyrostat/core/series.hpp>

namespace gyrostat {

/// The fit method called `name`; throws InputError at `place` otherwise.
FitMethod fit_method_named(const std::string& name, const std::string& place);

/// What a calibration span tells about a gyro: the thermal drift where there is temperature, and
/// the random error of what the drift leaves.
struct Calibration {
  std::optional<ThermalFit> thermal;
  ArimaFit random_error;
  double bias_measurement_std_dps = no_value;  ///< of M; NaN without a compass
  double compass_noise_std_deg = no_value;     ///< of one reading; NaN without a compass
  double start_temperature_C = no_value;
  double mean_dps = 0.0;       ///< of the rate error over the span
  double level_std_dps = 0.0;  ///< spread of the 10 s means about the drift
};

/// Fits a static span.
///
/// Example: a filter that starts from what the first minutes of a recording tell.
///
///   const Series recording = read_recording("REC.csv").series;
///   const Series still = cut(recording, 0.0, 300.0, "example");
///   const Calibration fitted = calibrate(still, FitMethod::likelihood);
///   const ParameterMap told = parameters_from(fitted, recording.temperature_C.front());
///   Track track;
///   run_filter(filter_types().named("kf", "example"), told, {}, recording, track);
///
/// Thread safety: may run in any number of threads at once; it starts none.
Calibration calibrate(const Series& series, FitMethod method);

/// What the random error is fitted to: the rate error in dps without its fitted drift, NaN where
/// the gyro value is missing.
std::vector<double> without_drift(const Series& series, const std::optional<ThermalFit>& thermal);

/// The calibration as parameters of filters. The first state is predicted from the drift at
/// `start_temperature_C`, with a spread that allows for the sensor's level.
ParameterMap parameters_from(const Calibration& calibration, double start_temperature_C);

}  // namespace gyrostat
