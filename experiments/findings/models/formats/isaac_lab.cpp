#include <cmath>

#include <fmt/format.h>

#include <gyrostat/experiments/findings/models/model_format.hpp>

namespace gyrostat {
namespace {

/// Isaac Lab's noise of an observation (isaaclab.utils.noise): white noise a step, and a bias drawn
/// at each reset. It has no walk; the bias is what the walk comes to over the averaging time.
std::string write_isaac_lab(const ModelSheet& sheet) {
  auto remarks = sheet.remarks;
  remarks.push_back(
      fmt::format("The bias of an episode is the walk's over {:.3g} s; the step is one "
                  "sample, at {:.6g} Hz.",
                  sheet.averaging_s, sheet.model.rate_hz));
  return commented(remarks, "#") +
         "from isaaclab.utils.noise import GaussianNoiseCfg, NoiseModelWithAdditiveBiasCfg\n\n"
         "gyro_noise = NoiseModelWithAdditiveBiasCfg(  # rad/s\n" +
         fmt::format("    noise_cfg=GaussianNoiseCfg(mean=0.0, std={:.9e}, operation=\"add\"),\n",
                     sheet.N * std::sqrt(sheet.model.rate_hz)) +
         fmt::format(
             "    bias_noise_cfg=GaussianNoiseCfg(mean={:.9e}, std={:.9e}, "
             "operation=\"abs\"),\n)\n",
             radians * sheet.model.constant_bias_dps, sheet.K * std::sqrt(sheet.averaging_s));
}

}  // namespace

ModelFormat model_format_isaac_lab() {
  return {.id = "isaac_lab",
          .title = "Isaac Lab's noise configuration",
          .file = "gyro_noise.py",
          .holds = {},
          .holds_walk = false,
          .write = write_isaac_lab};
}

}  // namespace gyrostat
