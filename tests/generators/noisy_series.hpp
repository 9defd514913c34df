#pragma once

#include <vector>

#include <gyrostat/generators/random_error.hpp>
#include <gyrostat/tests/generators/effect_series.hpp>

namespace gyrostat {

/// White noise of standard deviation 0.2 on a gyro that turns, drifts and wanders.
inline Series noisy(std::size_t samples, double rate_hz) {
  auto series = silent(even_times(samples, rate_hz));
  for (std::size_t i = 0; i < samples; ++i) {
    series.rate_ref_dps[i] = i / 100 % 2 == 0 ? 20.0 : -20.0;
    series.thermal_bias_dps[i] = 1e-5 * static_cast<double>(i);
    series.random_error_dps[i] = i % 7 == 0 ? 0.1 : 0.0;
    series.gyro_dps[i] =
        series.rate_ref_dps[i] + series.thermal_bias_dps[i] + series.random_error_dps[i];
  }
  add_white_noise(0.2, NormalStream(1, 0, "white_noise"), series.gyro_dps);
  return series;
}

/// What is left of it without rate, drift and random error.
inline std::vector<double> white_part(const Series& series) {
  std::vector<double> white;
  for (std::size_t i = 0; i < series.size(); ++i)
    white.push_back(series.gyro_dps[i] - series.rate_ref_dps[i] - series.thermal_bias_dps[i] -
                    series.random_error_dps[i]);
  return white;
}

}  // namespace gyrostat
