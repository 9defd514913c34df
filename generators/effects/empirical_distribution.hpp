#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/fast_part.hpp>
#include <gyrostat/generators/rising_map.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// All fast errors of the rate together take another distribution: a deviation of size from_k
/// becomes one of size to_k, on straight lines between and beyond. With the quantiles of what there
/// was and of what is to be for knots, that is the one rising map from the one distribution to the
/// other. It is not in the catalogue, and is never named as a cause.
struct EmpiricalDistribution {
  double from_1_dps = 0.1, to_1_dps = 0.1;
  double from_2_dps = 0.3, to_2_dps = 0.6;
  double from_3_dps = 0.0, to_3_dps = 0.0;
  double from_4_dps = 0.0, to_4_dps = 0.0;
  double from_5_dps = 0.0, to_5_dps = 0.0;
  double from_6_dps = 0.0, to_6_dps = 0.0;
  double from_7_dps = 0.0, to_7_dps = 0.0;
  double from_8_dps = 0.0, to_8_dps = 0.0;

  static constexpr std::string_view title = "fast errors have a distribution without a name";
  static constexpr Stage stage = Stage::conversion;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps,
                                       &Series::thermal_bias_dps, &Series::random_error_dps};

  static constexpr auto fields() {
    using P = EmpiricalDistribution;
    constexpr auto& from = "a size of a deviation; 0, or no larger than the one before: none";
    constexpr auto& to = "what it becomes";
    return std::array{
        Field{"from_1_dps", &P::from_1_dps, "dps", ranges::non_negative, from},
        Field{"to_1_dps", &P::to_1_dps, "dps", ranges::non_negative, to},
        Field{"from_2_dps", &P::from_2_dps, "dps", ranges::non_negative, from},
        Field{"to_2_dps", &P::to_2_dps, "dps", ranges::non_negative, to},
        Field{"from_3_dps", &P::from_3_dps, "dps", ranges::non_negative, from},
        Field{"to_3_dps", &P::to_3_dps, "dps", ranges::non_negative, to},
        Field{"from_4_dps", &P::from_4_dps, "dps", ranges::non_negative, from},
        Field{"to_4_dps", &P::to_4_dps, "dps", ranges::non_negative, to},
        Field{"from_5_dps", &P::from_5_dps, "dps", ranges::non_negative, from},
        Field{"to_5_dps", &P::to_5_dps, "dps", ranges::non_negative, to},
        Field{"from_6_dps", &P::from_6_dps, "dps", ranges::non_negative, from},
        Field{"to_6_dps", &P::to_6_dps, "dps", ranges::non_negative, to},
        Field{"from_7_dps", &P::from_7_dps, "dps", ranges::non_negative, from},
        Field{"to_7_dps", &P::to_7_dps, "dps", ranges::non_negative, to},
        Field{"from_8_dps", &P::from_8_dps, "dps", ranges::non_negative, from},
        Field{"to_8_dps", &P::to_8_dps, "dps", ranges::non_negative, to},
    };
  }

  static constexpr std::size_t most_knots = 8;
  static constexpr EmpiricalDistribution absent() {
    return {.from_1_dps = 0.0, .to_1_dps = 0.0, .from_2_dps = 0.0, .to_2_dps = 0.0};
  }

  RisingMap<most_knots> map() const {
    return RisingMap<most_knots>({{{from_1_dps, to_1_dps},
                                   {from_2_dps, to_2_dps},
                                   {from_3_dps, to_3_dps},
                                   {from_4_dps, to_4_dps},
                                   {from_5_dps, to_5_dps},
                                   {from_6_dps, to_6_dps},
                                   {from_7_dps, to_7_dps},
                                   {from_8_dps, to_8_dps}}});
  }

  void apply(Series& series, const Noise& /*noise*/) const {
    const auto change = map();
    if (change.is_empty()) return;
    FastPart part;
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double fast = part(series.t_s, i, error_beside_drift(series, i));
      series.gyro_dps[i] += change(fast) - fast;
    }
  }
};

}  // namespace gyrostat::effects
