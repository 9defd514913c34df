#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>
#include <gyrostat/generators/wander.hpp>

namespace gyrostat::effects {

/// The rate wanders as a Gauss-Markov process, beside what is named: what its covariance shows. It
/// is not in the catalogue, and is never named as a cause.
struct EmpiricalWander {
  double std_dps = 0.05;
  double time_s = 10.0;

  static constexpr std::string_view title = "the rate has a slow error without a name";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = EmpiricalWander;
    return std::array{
        Field{"std_dps", &P::std_dps, "dps", ranges::non_negative, "standard deviation"},
        Field{"time_s", &P::time_s, "s", ranges::positive, "correlation time"},
    };
  }

  static constexpr EmpiricalWander absent() { return {.std_dps = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    if (std_dps == 0.0) return;
    Wander wander(noise.stream("empirical_wander"), std_dps, time_s);
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] += wander(series.t_s, i);
  }
};

}  // namespace gyrostat::effects
