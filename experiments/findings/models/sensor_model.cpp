#include <gyrostat/experiments/findings/models/sensor_model.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gyrostat/analysis/calibration.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/set_fit.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/scenario_reading.hpp>
#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/generators/effects/bias_instability.hpp>

namespace gyrostat {
namespace {

AllanCoefficient known(double value) {
  return {.value = value, .standard_error = no_value, .lower = value, .upper = value};
}

/// Of values that are there sample by sample.
AllanCoefficients coefficients_of(const std::vector<double>& values, double rate_hz) {
  if (std::any_of(values.begin(), values.end(), [](double v) { return is_missing(v); }))
    throw InputError("recording",
                     "samples are missing; choose a span without gaps by --from and --to");
  return fit_allan_coefficients(values, rate_hz);
}

GapLadder ladder_of(const Json& diagnosis) {
  GapLadder ladder;
  ladder.before = diagnosis.at("gap").at("before").get<double>();
  for (const auto& step : diagnosis.at("steps"))
    if (const auto added = step.at("added").get<std::string>(); !added.empty())
      ladder.steps.emplace_back(added, step.at("gap").get<double>());
  for (const auto& effect : diagnosis.at("effects"))
    ladder.without.emplace_back(effect.at("effect").get<std::string>(),
                                effect.at("gap_without").get<double>());
  return ladder;
}

}  // namespace

SensorModel model_of_recording(const Series& recording) {
  SensorModel model;
  model.rate_hz = recording.rate_hz();
  model.duration_s = recording.duration_s();
  const auto fit = calibrate(recording, FitMethod::likelihood);
  const auto rate = without_drift(recording, fit.thermal);
  const auto found = coefficients_of(rate, model.rate_hz);
  model.N = found.angle_random_walk_dps_per_sqrt_hz;
  model.B = found.bias_instability_dps;
  model.K = found.rate_random_walk_dps_sqrt_hz;
  model.measured = overlapping_allan_deviation(rate, model.rate_hz);
  model.constant_bias_dps = fit.thermal ? fit.thermal->parameters.c_dps : fit.mean_dps;
  model.bias_dps_per_C = fit.thermal ? fit.thermal->parameters.a_dps_per_C : 0.0;
  for (const auto* axis : {&recording.acc_x_mps2, &recording.acc_y_mps2, &recording.acc_z_mps2}) {
    if (axis->empty()) continue;
    const auto acc = coefficients_of(*axis, model.rate_hz);
    auto& worst = model.accelerometer ? *model.accelerometer : model.accelerometer.emplace();
    worst.first = std::max(worst.first, acc.angle_random_walk_dps_per_sqrt_hz.value);
    worst.second = std::max(worst.second, acc.rate_random_walk_dps_sqrt_hz.value);
  }
  return model;
}

SensorModel model_of_scenario(const Scenario& scenario) {
  SensorModel model;
  model.scenario = scenario;
  model.rate_hz = scenario.sampling.rate_hz;
  model.duration_s = scenario.sampling.duration_s;
  Scenario alone = scenario;
  alone.effects.clear();
  const auto law = gap::law_of(alone, 1.0 / model.rate_hz);
  model.N = known(std::sqrt(law.white / model.rate_hz));
  model.K = known(std::sqrt(law.walk));
  for (const auto& effect : scenario.effects)
    if (const auto* flicker = effect.as<effects::BiasInstability>())
      model.B = known(std::hypot(model.B.value, flicker->coefficient_dps));
  model.constant_bias_dps = scenario.thermal_drift.c_dps;
  model.bias_dps_per_C = scenario.thermal_drift.a_dps_per_C;
  return model;
}

SensorModel read_model(const std::string& path, const std::string& cell) {
  const Json json = read_json(path);
  const auto name = std::filesystem::path(path).filename().string();
  if (!json.is_object() || !json.contains("verdict")) {
    auto model = model_of_scenario(cell_named(read_study(path), cell, "--cell").scenario);
    model.source = name + ": a study's scenario";
    return model;
  }
  if (!json.contains("enriched"))
    throw InputError(path,
                     "\"enriched\" is missing, as in what diagnose wrote before 0.2.0; "
                     "diagnose once more");
  FittedRecordings none;
  SensorModel model;
  try {
    const Json& enriched = json.at("enriched");
    model = model_of_scenario(read_scenario(JsonObject(enriched, path + ": enriched"), "", none));
    model.gap = ladder_of(json);
  } catch (const Json::exception& wrong) {
    throw InputError(path, std::string("is not what diagnose --json writes: ") + wrong.what());
  }
  model.source = name + ": a diagnosis";
  return model;
}

}  // namespace gyrostat
