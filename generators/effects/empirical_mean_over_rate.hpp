#pragma once

#include <string_view>

#include <gyrostat/generators/empirical_mean.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

struct OverRate {
  static constexpr std::string_view title = "the rate error depends on the rate, without a name";
  static constexpr Stage stage = Stage::electronics;
  static constexpr auto channel = &Series::rate_ref_dps, onto = &Series::gyro_dps;
  static constexpr char from[] = "from_dps", span[] = "span_dps", unit[] = "dps";
  static constexpr double first = -100.0, whole = 200.0;
};

/// The rate error follows the true rate along straight lines between nine even knots, from the
/// first to the last; beyond, the values of the ends. It is not in the catalogue, and is never
/// named as a cause.
using EmpiricalMeanOverRate = EmpiricalMean<OverRate>;

}  // namespace gyrostat::effects
