#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>
#include <gyrostat/generators/wander.hpp>

namespace gyrostat::effects {

/// The heading wanders as a Gauss-Markov process, beside what is named: what its covariance shows.
/// It is not in the catalogue, and is never named as a cause.
struct EmpiricalCompassWander {
  double std_deg = 0.05;
  double time_s = 10.0;

  static constexpr std::string_view title = "the compass has a slow error without a name";
  static constexpr Stage stage = Stage::compass;
  static constexpr std::array needs = {&Series::heading_deg};

  static constexpr auto fields() {
    using P = EmpiricalCompassWander;
    return std::array{
        Field{"std_deg", &P::std_deg, "deg", ranges::non_negative, "standard deviation"},
        Field{"time_s", &P::time_s, "s", ranges::positive, "correlation time"},
    };
  }

  static constexpr EmpiricalCompassWander absent() { return {.std_deg = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    if (std_deg == 0.0) return;
    Wander wander(noise.stream("empirical_compass_wander"), std_deg, time_s);
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.heading_deg[i] += wander(series.t_s, i);
  }
};

}  // namespace gyrostat::effects
