#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <gyrostat/experiments/findings/models/model_format.hpp>

namespace gyrostat {
namespace {

/// The gyro in the robot configuration of Project AirSim: AirSim's model in SI units.
std::string write_project_airsim(const ModelSheet& sheet) {
  constexpr double tau_s = 500.0;
  const auto bias = fmt::format("{0:.9e} {0:.9e} {0:.9e}", radians * sheet.model.constant_bias_dps);
  nlohmann::ordered_json sensor = {{"id", "IMU1"},
                                   {"type", "imu"},
                                   {"enabled", true},
                                   {"gyroscope",
                                    {{"angle-random-walk", sheet.N},
                                     {"tau", tau_s},
                                     {"bias-stability", sheet.K * std::sqrt(tau_s)},
                                     {"turn-on-bias", bias}}}};
  nlohmann::ordered_json robot = {{"_comment", sheet.remarks},
                                  {"sensors", nlohmann::ordered_json::array({sensor})}};
  return robot.dump(2) + '\n';
}

}  // namespace

ModelFormat model_format_project_airsim() {
  return {.id = "project_airsim",
          .title = "Project AirSim's robot configuration",
          .file = "robot.jsonc",
          .holds = {},
          .write = write_project_airsim};
}

}  // namespace gyrostat
