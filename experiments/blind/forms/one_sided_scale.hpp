#pragma once

#include <algorithm>
#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::gap::forms {

/// Rates of one sign alone are scaled wrongly: half an asymmetry and half a scale factor.
struct OneSidedScale {
  double error = 0.01;

  static constexpr std::string_view title = "one direction is scaled wrongly";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps};

  static constexpr auto fields() {
    using P = OneSidedScale;
    return std::array{
        Field{"error", &P::error, "1", ranges::any, "error of the scale factor of positive rates"}};
  }
  static constexpr OneSidedScale absent() { return {.error = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] += error * std::max(series.rate_ref_dps[i], 0.0);
  }
};

}  // namespace gyrostat::gap::forms
