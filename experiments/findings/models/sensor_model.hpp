#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/analysis/spectra/allan_coefficients.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat {

/// How far the gap of a diagnosis goes, effect by effect.
struct GapLadder {
  double before = 0.0;                                  ///< of white noise and a walk alone
  std::vector<std::pair<std::string, double>> steps;    ///< added, and the gap from there on
  std::vector<std::pair<std::string, double>> without;  ///< left out, and the gap of the others
};

/// The noise of a gyro as other simulators and filters ask for it: N, B and K in dps, with what is
/// there beside them.
struct SensorModel {
  std::string source;  ///< what it was made from, in words
  double rate_hz = 0.0;
  double duration_s = 0.0;
  AllanCoefficient N;  ///< angle random walk, dps/√Hz
  AllanCoefficient B;  ///< bias instability, dps
  AllanCoefficient K;  ///< rate random walk, dps·√Hz
  double constant_bias_dps = 0.0;
  double bias_dps_per_C = 0.0;
  Scenario scenario;                 ///< of a study or a diagnosis: all noise and effects
  std::vector<AllanPoint> measured;  ///< of a recording: its Allan deviation
  std::optional<GapLadder> gap;      ///< of a diagnosis
  /// Of a recording at rest with an accelerometer, its noisiest axis, in m/s²: N and K.
  std::optional<std::pair<double, double>> accelerometer;
};

/// N, B and K from the Allan deviation of a recording at rest, without its drift over temperature.
/// InputError where samples are missing or too few.
SensorModel model_of_recording(const Series& recording);

/// Those of a scenario: N of its white noise, K of its walk, B of its bias instability.
SensorModel model_of_scenario(const Scenario& scenario);

/// Of a JSON file: what `diagnose --json` wrote, or a study (its cell of that name, else the
/// first). InputError where it is neither.
SensorModel read_model(const std::string& path, const std::string& cell);

}  // namespace gyrostat
