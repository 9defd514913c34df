#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The gyro follows the rates of nine neighbouring samples, beside all that has a name: sample i
/// has sum of weight_k rate(i + k - 5) more (a response of finite length: Oppenheim
/// and Schafer, "Discrete-Time Signal Processing", 3rd ed., 2.4). Before the first and after the
/// last sample the rate is theirs, where it is missing that of the middle one. It is not in the
/// catalogue, and is never named as a cause.
struct EmpiricalResponse {
  double weight_1 = 0.0, weight_2 = 0.0, weight_3 = 0.0, weight_4 = 0.1, weight_5 = -0.2,
         weight_6 = 0.1, weight_7 = 0.0, weight_8 = 0.0, weight_9 = 0.0;

  static constexpr std::string_view title = "the rate is followed otherwise, without a name";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps};

  static constexpr auto fields() {
    using P = EmpiricalResponse;
    constexpr auto& weight = "of its sample, the earliest first";
    return std::array{
        Field{"weight_1", &P::weight_1, "1", ranges::any, weight},
        Field{"weight_2", &P::weight_2, "1", ranges::any, weight},
        Field{"weight_3", &P::weight_3, "1", ranges::any, weight},
        Field{"weight_4", &P::weight_4, "1", ranges::any, weight},
        Field{"weight_5", &P::weight_5, "1", ranges::any, weight},
        Field{"weight_6", &P::weight_6, "1", ranges::any, weight},
        Field{"weight_7", &P::weight_7, "1", ranges::any, weight},
        Field{"weight_8", &P::weight_8, "1", ranges::any, weight},
        Field{"weight_9", &P::weight_9, "1", ranges::any, weight},
    };
  }

  static constexpr std::size_t samples = 9;
  static constexpr EmpiricalResponse absent() {
    return {.weight_4 = 0.0, .weight_5 = 0.0, .weight_6 = 0.0};
  }

  Response response() const { return Response::of_electronics; }

  void apply(Series& series, const Noise& /*noise*/) const {
    const std::array weights{weight_1, weight_2, weight_3, weight_4, weight_5,
                             weight_6, weight_7, weight_8, weight_9};
    if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0.0; })) return;
    const auto n = static_cast<std::ptrdiff_t>(samples_with(series, needs));
    constexpr auto middle = static_cast<std::ptrdiff_t>(samples / 2);
    const auto rate = [&](std::ptrdiff_t i) {
      return series.rate_ref_dps[static_cast<std::size_t>(std::clamp(i, std::ptrdiff_t{0}, n - 1))];
    };
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      const double own = rate(i);
      double more = 0.0;
      for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(samples); ++k) {
        const double seen = rate(i + k - middle);
        more += weights[static_cast<std::size_t>(k)] * (std::isnan(seen) ? own : seen);
      }
      if (!std::isnan(more)) series.gyro_dps[static_cast<std::size_t>(i)] += more;
    }
  }
};

}  // namespace gyrostat::effects
