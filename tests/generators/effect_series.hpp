#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <gyrostat/core/series.hpp>
#include <gyrostat/generators/effects/list.hpp>

namespace gyrostat {

/// A signal of zeros at these times, at 25 °C, with the channels that effects act on.
inline Series silent(std::vector<double> t_s) {
  Series series;
  const std::size_t samples = t_s.size();
  series.t_s = std::move(t_s);
  for (const auto channel : {&Series::gyro_dps, &Series::rate_ref_dps, &Series::heading_deg,
                             &Series::thermal_bias_dps, &Series::random_error_dps})
    (series.*channel).assign(samples, 0.0);
  series.temperature_C.assign(samples, 25.0);
  return series;
}

inline std::vector<double> even_times(std::size_t samples, double rate_hz) {
  std::vector<double> t_s;
  for (std::size_t i = 0; i < samples; ++i) t_s.push_back(static_cast<double>(i) / rate_hz);
  return t_s;
}

/// What the effect adds to a silent gyro.
template <class Effect>
std::vector<double> added(const Effect& effect, std::vector<double> t_s, std::uint32_t trial = 0) {
  auto series = silent(std::move(t_s));
  effect.apply(series, {1, trial});
  return series.gyro_dps;
}

/// The gyro of a noiseless sensor with this effect at these rates, 0.01 s apart.
template <class Effect>
std::vector<double> sensed(const Effect& effect, const std::vector<double>& rates) {
  auto series = silent(even_times(rates.size(), 100.0));
  series.rate_ref_dps = series.gyro_dps = rates;
  effect.apply(series, {1, 0});
  return series.gyro_dps;
}

/// The mean of v_i v_j over trials.
template <class Draw>
double mean_product(const Draw& draw, std::uint32_t trials, std::size_t i, std::size_t j) {
  double sum = 0.0;
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    const auto v = draw(trial);
    sum += v[i] * v[j];
  }
  return sum / trials;
}

inline double mean_square(const std::vector<double>& v) {
  double sum = 0.0;
  for (const double x : v) sum += x * x;
  return sum / static_cast<double>(v.size());
}

/// The mean of v_i v_{i + lag}.
inline double autocovariance(const std::vector<double>& v, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t i = 0; i + lag < v.size(); ++i) sum += v[i] * v[i + lag];
  return sum / static_cast<double>(v.size() - lag);
}

}  // namespace gyrostat
