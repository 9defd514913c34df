#pragma once

#include <gyrostat/core/fields.hpp>

namespace gyrostat::motion {

/// No rotation.
struct Stationary {
  static constexpr std::string_view title = "no rotation";

  static constexpr auto fields() { return std::array<Field<Stationary, double>, 0>{}; }

  double operator()(double /*t_s*/) const { return 0.0; }
};

}  // namespace gyrostat::motion
