#pragma once

#include <array>
#include <cmath>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/sampled.hpp>
#include <gyrostat/generators/stage.hpp>

namespace gyrostat::effects {

/// The converter's grid: each value becomes the nearest multiple of the least significant bit
/// (IEEE Std 952 annex C, quantization noise; variance lsb^2 / 12), or of a grid that a bias taken
/// out after the converter has moved. A driver that casts to integers cuts off towards zero
/// instead. What is done to the values afterwards may leave noise about the grid.
struct Quantization {
  double lsb_dps = 0.05;
  double offset_dps = 0.0;
  double towards_zero = 0.0;
  double after_dps = 0.0;

  static constexpr std::string_view title = "values lie on a grid";
  static constexpr Stage stage = Stage::conversion;
  static constexpr std::array needs = {&Series::gyro_dps};

  static constexpr auto fields() {
    using P = Quantization;
    return std::array{
        Field{"lsb_dps", &P::lsb_dps, "dps", ranges::non_negative,
              "least significant bit; 0 leaves the values as they are"},
        Field{"offset_dps", &P::offset_dps, "dps", ranges::any, "a value of the grid"},
        Field{"towards_zero", &P::towards_zero, "1", ranges::flag,
              "1: values are cut off towards the offset; 0: rounded to the nearest of the grid"},
        Field{"after_dps", &P::after_dps, "dps", ranges::non_negative,
              "standard deviation of white noise that comes after it"},
    };
  }

  static constexpr Quantization absent() { return {.lsb_dps = 0.0}; }

  bool is_sample_by_sample() const { return after_dps == 0.0; }

  void apply(Series& series, const Noise& noise) const {
    if (lsb_dps != 0.0) round(series.gyro_dps);
    if (after_dps == 0.0) return;
    const auto after = noise.stream("quantization/after");
    for (std::size_t i = 0, n = samples_with(series, needs); i < n; ++i)
      series.gyro_dps[i] += after_dps * after.normal(i);
  }

 private:
  void round(std::vector<double>& gyro_dps) const {
    if (towards_zero != 0.0)
      for (double& z : gyro_dps) z = offset_dps + lsb_dps * std::trunc((z - offset_dps) / lsb_dps);
    else if (offset_dps == 0.0)
      for (double& z : gyro_dps) z = lsb_dps * std::nearbyint(z / lsb_dps);
    else
      for (double& z : gyro_dps)
        z = offset_dps + lsb_dps * std::nearbyint((z - offset_dps) / lsb_dps);
  }
};

}  // namespace gyrostat::effects
