#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::gap::forms {

/// The converter cuts off what is below its least significant bit, towards zero.
struct Truncation {
  double lsb_dps = 0.05;

  static constexpr std::string_view title = "values are cut off to a grid";
  static constexpr Stage stage = Stage::conversion;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = Truncation;
    return std::array{
        Field{"lsb_dps", &P::lsb_dps, "dps", ranges::non_negative, "least significant bit"}};
  }
  static constexpr Truncation absent() { return {.lsb_dps = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    if (lsb_dps == 0.0) return;
    for (double& z : series.gyro_dps) z = lsb_dps * std::trunc(z / lsb_dps);
  }
};

}  // namespace gyrostat::gap::forms
