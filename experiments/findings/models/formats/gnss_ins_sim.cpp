#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/models/model_format.hpp>
#include <gyrostat/generators/effects/gauss_markov.hpp>

namespace gyrostat {
namespace {

/// The dictionary that gnss-ins-sim's IMU takes as `accuracy` (gnss_ins_sim/sim/imu_model.py):
/// deg/h and deg/sqrt(h). Its one bias is Gauss-Markov from 0 on; an infinite correlation time
/// would make it white noise (pathgen.py, bias_drift), so a walk is one of a time that no run
/// lasts: then stability = K sqrt(correlation time / 2).
std::string write_gnss_ins_sim(const ModelSheet& sheet) {
  const auto& model = sheet.model;
  double correlation_s = std::max(1e5, 100.0 * model.duration_s);
  double stability = sheet.K * std::sqrt(0.5 * correlation_s);
  auto remarks = sheet.remarks;
  for (const auto& effect : model.scenario.effects)
    if (const auto* bias = effect.as<effects::GaussMarkov>()) {
      correlation_s = bias->correlation_time_s;
      stability = radians * bias->std_dps;
      remarks.emplace_back("Its one drifting bias is gauss_markov; the walk K finds no place.");
      if (bias->is_of_second_order())
        remarks.emplace_back("It is of first order there, and of second order was found.");
    }
  const auto of_each = [](const char* key, double value, const char* unit) {
    return fmt::format("    '{0}': np.array([{1:.9e}, {1:.9e}, {1:.9e}]),  # {2}\n", key, value,
                       unit);
  };
  return commented(remarks, "#") + "import numpy as np\n\nimu_err = {\n" +
         of_each("gyro_b", bias_instability_deg_per_h(model.constant_bias_dps), "deg/h") +
         of_each("gyro_arw", angle_random_walk_deg_per_sqrt_h(sheet.N / radians), "deg/sqrt(h)") +
         of_each("gyro_b_stability", bias_instability_deg_per_h(stability / radians), "deg/h") +
         of_each("gyro_b_corr", correlation_s, "s") +
         "    # accel_b, accel_vrw, accel_b_stability, accel_b_corr: not known from a gyro\n}\n";
}

}  // namespace

ModelFormat model_format_gnss_ins_sim() {
  return {.id = "gnss_ins_sim",
          .title = "gnss-ins-sim's imu_err",
          .file = "imu_err.py",
          .holds = {"gauss_markov"},
          .write = write_gnss_ins_sim};
}

}  // namespace gyrostat
