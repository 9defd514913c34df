#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/models/model_format.hpp>

namespace gyrostat {
namespace {

/// Parameters of ArduPilot's EKF3, which predicts every 12 ms (EKF_TARGET_DT): a turn over a step
/// has the variance (dt EK3_GYRO_P_NSE)², the bias of that turn gains (dt² EK3_GBIAS_P_NSE)². So
/// they are N / sqrt(dt) and K / sqrt(dt). SIM_GYR1_RND is no white noise of the sensor (it follows
/// the throttle), so it is left alone.
std::string write_ardupilot(const ModelSheet& sheet) {
  constexpr double step_s = 0.012;
  auto remarks = sheet.remarks;
  std::string rows;
  const auto row = [&](const char* name, double value, double least, double most) {
    const double allowed = std::clamp(value, least, most);
    if (allowed != value)
      remarks.push_back(fmt::format("{} would be {:.4g}; ArduPilot allows {:g} to {:g}.", name,
                                    value, least, most));
    rows += fmt::format("{},{:.9f}\n", name, allowed);
  };
  row("EK3_GYRO_P_NSE", sheet.N / std::sqrt(step_s), 0.0001, 0.1);
  row("EK3_GBIAS_P_NSE", sheet.K / std::sqrt(step_s), 0.00001, 0.001);
  return commented(remarks, "#") + rows;
}

}  // namespace

ModelFormat model_format_ardupilot() {
  return {.id = "ardupilot",
          .title = "ArduPilot's EKF3 parameters",
          .file = "gyro.parm",
          .holds = {},
          .write = write_ardupilot};
}

}  // namespace gyrostat
