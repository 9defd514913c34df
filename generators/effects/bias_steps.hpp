#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The bias jumps at the times of a Poisson process, by a normal amount each time (compound Poisson
/// process): its variance grows by std^2 at each expected jump.
struct BiasSteps {
  double steps_per_hour = 10.0;
  double std_dps = 0.01;

  static constexpr std::string_view title = "the bias jumps and stays";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = BiasSteps;
    return std::array{
        Field{"steps_per_hour", &P::steps_per_hour, "1/h", Range{.from = 0, .to = 1e6},
              "mean number of jumps an hour"},
        Field{"std_dps", &P::std_dps, "dps", ranges::non_negative, "standard deviation of a jump"},
    };
  }

  static constexpr BiasSteps absent() { return {.std_dps = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    const auto waits = noise.stream("bias_steps/wait");
    const auto sizes = noise.stream("bias_steps/size");
    std::uint64_t jump = 0;
    const auto wait_s = [&] { return -std::log(waits.uniform(jump)) * 3600.0 / steps_per_hour; };
    double level = 0.0, next_s = wait_s();
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double t_s = series.t_s[i] - series.t_s[0];
      for (; t_s >= next_s; next_s += wait_s()) level += std_dps * sizes.normal(jump++);
      series.gyro_dps[i] += level;
    }
  }
};

}  // namespace gyrostat::effects
