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

/// Whether an effect says how the rate is sensed, and where: such effects come before the others of
/// their stages, to which the rate is what is sensed.
enum class Response {
  none,
  of_element,      ///< before what the electronics make of the rate
  of_electronics,  ///< stage by stage
};

}  // namespace gyrostat
