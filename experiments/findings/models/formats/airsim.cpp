#include <cmath>

#include <nlohmann/json.hpp>

#include <gyrostat/experiments/findings/models/model_format.hpp>

namespace gyrostat {
namespace {

/// The gyro in AirSim's settings.json (ImuSimpleParams.hpp): deg/sqrt(h), and a bias that walks by
/// GyroBiasStability / sqrt(GyroBiasStabilityTau), deg/h and s. JSON has no comments: "_comment".
std::string write_airsim(const ModelSheet& sheet) {
  constexpr double tau_s = 500.0;
  nlohmann::ordered_json imu = {
      {"SensorType", 2},
      {"Enabled", true},
      {"AngularRandomWalk", angle_random_walk_deg_per_sqrt_h(sheet.N / radians)},
      {"GyroBiasStabilityTau", tau_s},
      {"GyroBiasStability", bias_instability_deg_per_h(sheet.K * std::sqrt(tau_s) / radians)}};
  nlohmann::ordered_json settings = {{"_comment", sheet.remarks},
                                     {"DefaultSensors", {{"Imu", imu}}}};
  return settings.dump(2) + '\n';
}

}  // namespace

ModelFormat model_format_airsim() {
  return {.id = "airsim",
          .title = "AirSim's settings.json",
          .file = "settings.json",
          .holds = {},
          .write = write_airsim};
}

}  // namespace gyrostat
