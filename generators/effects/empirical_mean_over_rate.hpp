#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/linear_spline.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The rate error follows the true rate along straight lines between nine even knots, from the
/// first to the last; beyond, the values of the ends. It is not in the catalogue, and is never
/// named as a cause.
struct EmpiricalMeanOverRate {
  double from_dps = -100.0, span_dps = 200.0;
  double mean_1_dps = 0.0, mean_2_dps = 0.0, mean_3_dps = 0.0, mean_4_dps = 0.0, mean_5_dps = 0.05,
         mean_6_dps = 0.0, mean_7_dps = 0.0, mean_8_dps = 0.0, mean_9_dps = 0.0;

  static constexpr std::string_view title = "the rate error depends on the rate, without a name";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::rate_ref_dps, &Series::gyro_dps};

  static constexpr auto fields() {
    using P = EmpiricalMeanOverRate;
    constexpr auto& mean = "at its knot";
    return std::array{
        Field{"from_dps", &P::from_dps, "dps", ranges::any, "true rate of the first knot"},
        Field{"span_dps", &P::span_dps, "dps", ranges::positive, "from the first knot to the last"},
        Field{"mean_1_dps", &P::mean_1_dps, "dps", ranges::any, mean},
        Field{"mean_2_dps", &P::mean_2_dps, "dps", ranges::any, mean},
        Field{"mean_3_dps", &P::mean_3_dps, "dps", ranges::any, mean},
        Field{"mean_4_dps", &P::mean_4_dps, "dps", ranges::any, mean},
        Field{"mean_5_dps", &P::mean_5_dps, "dps", ranges::any, mean},
        Field{"mean_6_dps", &P::mean_6_dps, "dps", ranges::any, mean},
        Field{"mean_7_dps", &P::mean_7_dps, "dps", ranges::any, mean},
        Field{"mean_8_dps", &P::mean_8_dps, "dps", ranges::any, mean},
        Field{"mean_9_dps", &P::mean_9_dps, "dps", ranges::any, mean},
    };
  }

  static constexpr EmpiricalMeanOverRate absent() { return {.mean_5_dps = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    const LinearSpline mean{from_dps,
                            span_dps,
                            {mean_1_dps, mean_2_dps, mean_3_dps, mean_4_dps, mean_5_dps, mean_6_dps,
                             mean_7_dps, mean_8_dps, mean_9_dps}};
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] += mean(series.rate_ref_dps[i]);
  }
};

}  // namespace gyrostat::effects
