#pragma once

namespace gyrostat {

/// Where in the physical chain an effect acts, and on which channel. Effects run stage by stage, in
/// a scenario's own order within a stage.
enum class Stage {
  environment,  ///< on temperature and true rate
  sensing,      ///< on the thermal drift (thermal_bias_dps)
  noise,  ///< on the white noise, while gyro_dps holds rate, drift, random error and nothing else
  electronics,  ///< on the analogue signal (gyro_dps): slow errors, response to the rate, gross
                ///< errors
  conversion,   ///< at the analogue-to-digital converter (gyro_dps)
  transport,    ///< between converter and recording (gyro_dps)
  compass,      ///< on heading_deg before its white noise, not yet wrapped to +-180
};

}  // namespace gyrostat
