#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// Random telegraph noise: the bias keeps to two levels and changes between them at the times of a
/// Poisson process; its density is a Lorentzian (Machlup, J. Appl. Phys. 25, 1954).
struct Telegraph {
  double amplitude_dps = 0.01;
  double mean_dwell_s = 60.0;

  static constexpr std::string_view title = "the bias switches between two levels";
  static constexpr Stage stage = Stage::electronics;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = Telegraph;
    return std::array{
        Field{"amplitude_dps", &P::amplitude_dps, "dps", ranges::non_negative,
              "half the distance of the levels"},
        Field{"mean_dwell_s", &P::mean_dwell_s, "s", Range{.from = 1e-3}, "mean time on a level"},
    };
  }

  static constexpr Telegraph absent() { return {.amplitude_dps = 0.0}; }

  void apply(Series& series, const Noise& noise) const {
    const auto chance = noise.stream("telegraph");
    std::uint64_t change = 0;
    double level = chance.uniform(change++) < 0.5 ? -amplitude_dps : amplitude_dps;
    const auto wait_s = [&] { return -std::log(chance.uniform(change++)) * mean_dwell_s; };
    double next_s = wait_s();
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      for (; series.t_s[i] - series.t_s[0] >= next_s; next_s += wait_s()) level = -level;
      series.gyro_dps[i] += level;
    }
  }
};

}  // namespace gyrostat::effects
