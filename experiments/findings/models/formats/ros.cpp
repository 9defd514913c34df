#include <cmath>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/models/model_format.hpp>

namespace gyrostat {
namespace {

/// A ROS 2 parameter file: the covariance that a driver puts into sensor_msgs/Imu, from which
/// robot_localization weighs it, and the two gains of imu_tools' imu_filter_madgwick, beta =
/// sqrt(3/4) of the gyro's error in a sample and zeta = sqrt(3/4) of its drift (Madgwick, "An
/// efficient orientation filter", 2010, eqs. 33 and 34).
std::string write_ros(const ModelSheet& sheet) {
  const double variance = sheet.N * sheet.N * sheet.model.rate_hz;
  auto remarks = sheet.remarks;
  remarks.push_back(
      fmt::format("The variance is that of a sample at {:.6g} Hz; the drift for zeta "
                  "is the walk's over {:.3g} s.",
                  sheet.model.rate_hz, sheet.averaging_s));
  const double share = std::sqrt(0.75);
  return commented(remarks, "#") + "/**:\n  ros__parameters:\n" +
         fmt::format("    angular_velocity_stdev: {:.9e}  # rad/s\n", std::sqrt(variance)) +
         fmt::format(
             "    angular_velocity_covariance: [{0:.9e}, 0.0, 0.0, 0.0, {0:.9e}, 0.0, 0.0, "
             "0.0, {0:.9e}]  # (rad/s)^2\n",
             variance) +
         fmt::format("    gain: {:.9e}  # rad/s, imu_filter_madgwick\n",
                     share * std::sqrt(variance)) +
         fmt::format("    zeta: {:.9e}  # rad/s^2, imu_filter_madgwick\n",
                     share * sheet.K / std::sqrt(sheet.averaging_s));
}

}  // namespace

ModelFormat model_format_ros() {
  return {.id = "ros",
          .title = "ROS 2 parameters for imu_tools and robot_localization",
          .file = "imu_ros.yaml",
          .holds = {},
          .write = write_ros};
}

}  // namespace gyrostat
