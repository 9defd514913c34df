#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/all_pole.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// White noise takes the spectrum of an autoregression: what a recording shows where no cause is
/// known. It is not in the catalogue, and is never named as one.
struct EmpiricalNoise {
  double gain = 1.0;
  double reflection_1 = -0.3, reflection_2 = 0.0, reflection_3 = 0.0, reflection_4 = 0.0,
         reflection_5 = 0.0, reflection_6 = 0.0, reflection_7 = 0.0, reflection_8 = 0.0;

  static constexpr std::string_view title = "the white noise has a colour without a name";
  static constexpr Stage stage = Stage::noise;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::rate_ref_dps,
                                       &Series::thermal_bias_dps, &Series::random_error_dps};

  static constexpr auto fields() {
    using P = EmpiricalNoise;
    constexpr Range stable{.from = -1, .to = 1};
    constexpr auto& of_order = "reflection coefficient of the autoregression";
    return std::array{
        Field{"gain", &P::gain, "1", ranges::positive, "of the white noise that drives it"},
        Field{"reflection_1", &P::reflection_1, "1", stable, of_order},
        Field{"reflection_2", &P::reflection_2, "1", stable, of_order},
        Field{"reflection_3", &P::reflection_3, "1", stable, of_order},
        Field{"reflection_4", &P::reflection_4, "1", stable, of_order},
        Field{"reflection_5", &P::reflection_5, "1", stable, of_order},
        Field{"reflection_6", &P::reflection_6, "1", stable, of_order},
        Field{"reflection_7", &P::reflection_7, "1", stable, of_order},
        Field{"reflection_8", &P::reflection_8, "1", stable, of_order},
    };
  }

  static constexpr std::size_t order = 8;
  static constexpr EmpiricalNoise absent() { return {.reflection_1 = 0.0}; }

  AllPole<order> filter() const {
    return AllPole<order>({reflection_1, reflection_2, reflection_3, reflection_4, reflection_5,
                           reflection_6, reflection_7, reflection_8});
  }

  void apply(Series& series, const Noise& /*noise*/) const {
    auto coloured = filter();
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i) {
      const double white = error_beside_drift(series, i);
      series.gyro_dps[i] += coloured(gain * white) - white;
    }
  }
};

}  // namespace gyrostat::effects
