#pragma once

#include <gyrostat/core/fields.hpp>

namespace gyrostat::acceleration {

/// At rest with its z axis up: the accelerometer shows the reaction to standard gravity.
struct Level {
  static constexpr std::string_view title = "at rest, z axis up";

  static constexpr auto fields() { return std::array<Field<Level, double>, 0>{}; }

  std::array<double, 3> operator()(double /*t_s*/) const { return {0.0, 0.0, 9.80665}; }
};

}  // namespace gyrostat::acceleration
