#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Regression coefficient, seconds, of the rate error on the angular acceleration so many seconds
/// before: a delayed or low-passed rate lags behind its reference.
struct ErrorOverLag : Lens {
  static constexpr std::string_view title = "rate error against past angular acceleration";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view coordinate = "time_s";
  static constexpr std::string_view unit = "s";

  ErrorOverLag(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    if (!seen.has_motion()) return;
    double energy = 0.0;
    for (const auto& span : spans())
      for (std::size_t i = span.first; i < span.last; ++i)
        energy += seen.motion_dps_s()[i] * seen.motion_dps_s()[i];
    if (energy == 0.0) return;
    for (std::size_t lag = 0; lag <= 64; lag = lag == 0 ? 1 : 2 * lag) {
      lags_.push_back(lag);
      const double lag_s = seen.interval_s() * static_cast<double>(lag);
      at.push_back({lag_s, lag_s});
    }
  }

  void read(const Scene& scene, std::span<double> out) const {
    auto reading = out.begin();
    const auto& motion = conditions->motion_dps_s();
    for (const std::size_t lag : lags_) {
      double product = 0.0, square = 0.0, sum = 0.0, accelerations = 0.0, count = 0.0;
      for (const auto& span : spans())
        for (std::size_t i = span.first + lag; i < span.last; ++i) {
          const double a = motion[i - lag];
          product += a * scene.rate_error_dps[i];
          sum += scene.rate_error_dps[i];
          accelerations += a;
          square += a * a;
          count += 1.0;
        }
      *reading++ = square > 0.0 ? (product - sum * accelerations / count) / square : 0.0;
    }
  }

 private:
  std::vector<std::size_t> lags_;
};

}  // namespace gyrostat::gap::lenses
