#pragma once

#include <array>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The bias follows the specific force (IEEE Std 952 and 1431, acceleration-sensitive drift rate).
struct GSensitivity {
  double x_dps_per_mps2 = 0.005;
  double y_dps_per_mps2 = 0.0;
  double z_dps_per_mps2 = 0.0;

  static constexpr std::string_view title = "the bias depends on acceleration";
  static constexpr Stage stage = Stage::electronics;
  static constexpr bool sample_by_sample = true;
  static constexpr std::array needs = {&Series::gyro_dps, &Series::acc_x_mps2, &Series::acc_y_mps2,
                                       &Series::acc_z_mps2};

  static constexpr auto fields() {
    using P = GSensitivity;
    return std::array{
        Field{"x_dps_per_mps2", &P::x_dps_per_mps2, "dps/(m/s²)", ranges::any,
              "sensitivity along x"},
        Field{"y_dps_per_mps2", &P::y_dps_per_mps2, "dps/(m/s²)", ranges::any,
              "sensitivity along y"},
        Field{"z_dps_per_mps2", &P::z_dps_per_mps2, "dps/(m/s²)", ranges::any,
              "sensitivity along z"},
    };
  }

  static constexpr GSensitivity absent() { return {.x_dps_per_mps2 = 0.0}; }

  void apply(Series& series, const Noise& /*noise*/) const {
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] += x_dps_per_mps2 * series.acc_x_mps2[i] +
                            y_dps_per_mps2 * series.acc_y_mps2[i] +
                            z_dps_per_mps2 * series.acc_z_mps2[i];
  }
};

}  // namespace gyrostat::effects
