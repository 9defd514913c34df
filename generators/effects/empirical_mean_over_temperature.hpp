#pragma once

#include <string_view>

#include <gyrostat/generators/empirical_mean.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

struct OverTemperature {
  static constexpr std::string_view title = "the bias depends on the temperature, without a name";
  static constexpr Stage stage = Stage::sensing;
  static constexpr auto channel = &Series::temperature_C, onto = &Series::thermal_bias_dps;
  static constexpr char from[] = "from_C", span[] = "span_C", unit[] = "°C";
  static constexpr double first = 23.0, whole = 34.0;
};

/// The bias follows the temperature along straight lines between nine even knots, beside the
/// thermal drift, from the first to the last; beyond, the values of the ends. It is not in the
/// catalogue, and is never named as a cause.
using EmpiricalMeanOverTemperature = EmpiricalMean<OverTemperature>;

}  // namespace gyrostat::effects
