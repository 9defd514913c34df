#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/models/model_format.hpp>
#include <gyrostat/generators/effects/gauss_markov.hpp>
#include <gyrostat/generators/effects/quantization.hpp>

namespace gyrostat {
namespace {

constexpr double walk_correlation_s = 1e7;

/// Gazebo's <noise> (SDFormat 1.6 and later; GaussianNoiseModel of gz-sensors): a standard
/// deviation a sample, a grid, and a bias b' = -b / tau + sigma w, whose standard deviation comes
/// to sigma sqrt(tau / 2); with a tau that no simulation lasts it is the walk of K = sigma.
std::string write_gazebo(const ModelSheet& sheet) {
  const auto& model = sheet.model;
  auto remarks = sheet.remarks;
  double drive = sheet.K, correlation_s = walk_correlation_s, precision = 0.0;
  for (const auto& effect : model.scenario.effects) {
    if (const auto* bias = effect.as<effects::GaussMarkov>()) {
      correlation_s = bias->correlation_time_s;
      drive = radians * bias->std_dps * std::sqrt(2.0 / correlation_s);
      remarks.emplace_back("Its one dynamic bias is gauss_markov; the walk K finds no place.");
      if (bias->is_of_second_order())
        remarks.emplace_back("It is of first order there, and of second order was found.");
    }
    if (const auto* grid = effect.as<effects::Quantization>()) precision = radians * grid->lsb_dps;
  }
  for (auto& remark : remarks)  // XML has no "--" in a comment
    for (std::size_t at = 0; (at = remark.find("--", at)) != std::string::npos;)
      remark.replace(at, 2, "- -");
  const auto axis = [&](const char* name) {
    return fmt::format(
        "            <{0}><noise type=\"{1}\">\n"
        "              <mean>0</mean>\n"
        "              <stddev>{2:.9e}</stddev>\n"
        "              <bias_mean>{3:.9e}</bias_mean>\n"
        "              <bias_stddev>0</bias_stddev>\n"
        "              <dynamic_bias_stddev>{4:.9e}</dynamic_bias_stddev>\n"
        "              <dynamic_bias_correlation_time>{5:.9e}</dynamic_bias_correlation_time>\n"
        "{6}            </noise></{0}>\n",
        name, precision > 0.0 ? "gaussian_quantized" : "gaussian",
        sheet.N * std::sqrt(model.rate_hz), radians * model.constant_bias_dps, drive, correlation_s,
        precision > 0.0 ? fmt::format("              <precision>{:.9e}</precision>\n", precision)
                        : "");
  };
  return "<?xml version=\"1.0\"?>\n<!--\n" + commented(remarks, " ") +
         "-->\n<sdf version=\"1.9\">\n  <model name=\"gyro\">\n    <link name=\"link\">\n"
         "      <sensor name=\"imu\" type=\"imu\">\n" +
         fmt::format("        <update_rate>{:.6f}</update_rate>\n", model.rate_hz) +
         "        <imu>\n          <angular_velocity>\n" + axis("x") + axis("y") + axis("z") +
         "          </angular_velocity>\n        </imu>\n      </sensor>\n    </link>\n  "
         "</model>\n</sdf>\n";
}

}  // namespace

ModelFormat model_format_gazebo() {
  return {.id = "gazebo",
          .title = "Gazebo's <noise> in SDF",
          .file = "gyro.sdf",
          .holds = {"gauss_markov", "quantization"},
          .write = write_gazebo};
}

}  // namespace gyrostat
