#include <fmt/format.h>

#include <gyrostat/experiments/findings/models/model_format.hpp>

namespace gyrostat {
namespace {

/// Kalibr's imu.yaml (its wiki, "IMU Noise Model" and "YAML formats"): continuous white noise and a
/// bias that walks.
std::string write_kalibr(const ModelSheet& sheet) {
  auto remarks = sheet.remarks;
  const auto& acc = sheet.model.accelerometer;
  if (!acc)
    remarks.emplace_back(
        "Nothing is known of an accelerometer here: put its two numbers in place "
        "of the lines that are commented out.");
  const auto accelerometer = [&](const char* key, double value, const char* unit) {
    return acc ? fmt::format("{}: {:.9e}  # {}\n", key, value, unit)
               : fmt::format("# {}:  # {}\n", key, unit);
  };
  return commented(remarks, "#") + "rostopic: /imu0\n" +
         fmt::format("update_rate: {:.6f}  # Hz\n", sheet.model.rate_hz) +
         fmt::format("gyroscope_noise_density: {:.9e}  # rad/s/sqrt(Hz)\n", sheet.N) +
         fmt::format("gyroscope_random_walk: {:.9e}  # rad/s^2/sqrt(Hz)\n", sheet.K) +
         accelerometer("accelerometer_noise_density", acc ? acc->first : 0.0, "m/s^2/sqrt(Hz)") +
         accelerometer("accelerometer_random_walk", acc ? acc->second : 0.0, "m/s^3/sqrt(Hz)");
}

}  // namespace

ModelFormat model_format_kalibr() {
  return {.id = "kalibr",
          .title = "Kalibr's imu.yaml",
          .file = "imu.yaml",
          .holds = {},
          .write = write_kalibr};
}

}  // namespace gyrostat
