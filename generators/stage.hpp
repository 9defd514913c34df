#pragma once

namespace gyrostat {

/// Where in the physical chain an effect acts. Effects run stage by stage, in a scenario's own
/// order within a stage.
enum class Stage {
  environment,  ///< on temperature and true rate
  sensing,      ///< on the thermal drift (thermal_bias_dps)
  noise,        ///< on the white noise alone: what the gyro holds beyond its other parts
  electronics,  ///< on the analogue signal, after random error and white noise
  conversion,   ///< at the analogue-to-digital converter
  transport,    ///< between converter and recording
  compass,      ///< on the heading
};

}  // namespace gyrostat
