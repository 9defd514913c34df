#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/models/model_format.hpp>
#include <gyrostat/generators/effects/quantization.hpp>
#include <gyrostat/generators/effects/saturation.hpp>

namespace gyrostat {
namespace {

/// A script that makes gyroparams for MATLAB's imuSensor (Navigation and Sensor Fusion toolboxes).
/// Its NoiseDensity, BiasInstability and RandomWalk are N, B and K; biases are at 25 °C.
std::string write_matlab(const ModelSheet& sheet) {
  constexpr double reference_C = 25.0;
  const auto& model = sheet.model;
  std::string further;
  const auto set = [&](const char* property, double value, const char* unit) {
    further += fmt::format("params.{} = {:.9e}; % {}\n", property, value, unit);
  };
  for (const auto& effect : model.scenario.effects) {
    if (const auto* grid = effect.as<effects::Quantization>())
      set("Resolution", radians * grid->lsb_dps, "(rad/s)/LSB");
    if (const auto* range = effect.as<effects::Saturation>())
      set("MeasurementRange", radians * std::max(range->limit_dps, range->below_dps), "rad/s");
  }
  if (model.bias_dps_per_C != 0.0)
    set("TemperatureBias", radians * model.bias_dps_per_C, "(rad/s)/degC");
  return commented(sheet.remarks, "%") + "params = gyroparams;\n" +
         fmt::format("params.NoiseDensity = {:.9e}; % (rad/s)/sqrt(Hz)\n", sheet.N) +
         fmt::format("params.BiasInstability = {:.9e}; % rad/s\n", sheet.B) +
         fmt::format("params.RandomWalk = {:.9e}; % (rad/s)*sqrt(Hz)\n", sheet.K) +
         fmt::format("params.ConstantBias = {:.9e}; % rad/s\n",
                     radians * (model.constant_bias_dps + reference_C * model.bias_dps_per_C)) +
         further +
         fmt::format("imu = imuSensor('accel-gyro', 'SampleRate', {:.6f}, 'Gyroscope', params);\n",
                     model.rate_hz);
}

}  // namespace

ModelFormat model_format_matlab() {
  return {.id = "matlab",
          .title = "MATLAB's gyroparams for imuSensor, a script",
          .file = "gyro_params.m",
          .holds = {"bias_instability", "quantization", "saturation"},
          .write = write_matlab};
}

}  // namespace gyrostat
