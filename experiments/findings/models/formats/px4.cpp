#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/models/model_format.hpp>

namespace gyrostat {
namespace {

/// Parameters of PX4's EKF2, as QGroundControl loads them. The filter predicts every
/// EKF2_PREDICT_US = 10 ms: EKF2_GYR_NOISE is the white noise of a mean over it, N / sqrt(dt), and
/// the bias gains (dt EKF2_GYR_B_NOISE)² in a step (EKF/covariance.cpp), so that is K / sqrt(dt).
std::string write_px4(const ModelSheet& sheet) {
  constexpr double step_s = 0.01;
  auto remarks = sheet.remarks;
  std::string rows;
  const auto row = [&](const char* name, double value, double least, double most) {
    const double allowed = std::clamp(value, least, most);
    if (allowed != value)
      remarks.push_back(
          fmt::format("{} would be {:.4g}; PX4 allows {:g} to {:g}.", name, value, least, most));
    rows += fmt::format("1\t1\t{}\t{:.9e}\t9\n", name, allowed);
  };
  row("EKF2_GYR_NOISE", sheet.N / std::sqrt(step_s), 0.0001, 0.1);
  row("EKF2_GYR_B_NOISE", sheet.K / std::sqrt(step_s), 0.0, 0.01);
  remarks.emplace_back("For EKF2_PREDICT_US = 10000. Vehicle, component, name, value, type:");
  return commented(remarks, "#") + rows;
}

}  // namespace

ModelFormat model_format_px4() {
  return {.id = "px4",
          .title = "PX4's EKF2 parameters",
          .file = "gyro.params",
          .holds = {},
          .write = write_px4};
}

}  // namespace gyrostat
