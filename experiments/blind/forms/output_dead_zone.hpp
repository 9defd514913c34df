#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::gap::forms {

/// The output is 0 wherever what would be written, noise and all, is below a threshold.
struct OutputDeadZone {
  double half_width_dps = 0.5;

  static constexpr std::string_view title = "small outputs are written as 0";
  static constexpr Stage stage = Stage::conversion;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = OutputDeadZone;
    return std::array{Field{"half_width_dps", &P::half_width_dps, "dps", ranges::non_negative,
                            "smallest output that is written"}};
  }
  static constexpr OutputDeadZone absent() { return {.half_width_dps = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (double& z : series.gyro_dps)
      if (std::abs(z) < half_width_dps) z = 0.0;
  }
};

}  // namespace gyrostat::gap::forms
