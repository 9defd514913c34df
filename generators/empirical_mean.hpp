#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/linear_spline.hpp>
#include <gyrostat/generators/sampled.hpp>

namespace gyrostat {

/// A channel that follows another along straight lines between nine even knots; beyond, the values
/// of the ends. `Over` says which: `channel` is followed and `onto` added to at a `stage`, under a
/// `title`; `from`, `span` and `unit` are of the field of the first knot and of the distance to the
/// last, which lie at `first` and `whole` where nothing is said.
template <class Over>
struct EmpiricalMean {
  double from = Over::first, span = Over::whole;
  double mean_1_dps = 0.0, mean_2_dps = 0.0, mean_3_dps = 0.0, mean_4_dps = 0.0, mean_5_dps = 0.05,
         mean_6_dps = 0.0, mean_7_dps = 0.0, mean_8_dps = 0.0, mean_9_dps = 0.0;

  static constexpr auto title = Over::title;
  static constexpr auto stage = Over::stage;
  static constexpr std::array needs = {Over::channel, Over::onto};

  static constexpr auto fields() {
    using P = EmpiricalMean;
    constexpr auto& mean = "at its knot";
    return std::array{
        Field{Over::from, &P::from, Over::unit, ranges::any, "of the first knot"},
        Field{Over::span, &P::span, Over::unit, ranges::positive,
              "from the first knot to the last"},
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

  static constexpr EmpiricalMean absent() { return {.mean_5_dps = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    const LinearSpline mean{from,
                            span,
                            {mean_1_dps, mean_2_dps, mean_3_dps, mean_4_dps, mean_5_dps, mean_6_dps,
                             mean_7_dps, mean_8_dps, mean_9_dps}};
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      (series.*Over::onto)[i] += mean((series.*Over::channel)[i]);
  }
};

}  // namespace gyrostat
