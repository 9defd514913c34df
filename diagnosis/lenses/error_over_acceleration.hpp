#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Regression coefficients, dps/(m/s²), of the slow rate error on the acceleration along x, y and
/// z.
struct ErrorOverAcceleration : Lens {
  static constexpr std::string_view title = "rate error against acceleration";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view coordinate = "amplitude_dps";
  static constexpr std::string_view unit = "dps/(m/s²)";

  ErrorOverAcceleration(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    if (!seen.has_acceleration()) return;
    for (const auto axis : {&Series::acc_x_mps2, &Series::acc_y_mps2, &Series::acc_z_mps2}) {
      if ((seen.series().*axis).empty()) continue;
      auto slow = seen.slow_means(seen.series().*axis);
      double sum = 0.0, square = 0.0, count = 0.0;
      for (const auto& span : slow_spans())
        for (std::size_t i = span.first; i < span.last; ++i) {
          sum += slow[i];
          square += slow[i] * slow[i];
          count += 1.0;
        }
      const double mean = sum / std::max(count, 1.0);
      if (count < 32.0 || square / count - mean * mean < 0.04) continue;
      for (auto& value : slow) value -= mean;
      axes_.push_back(std::move(slow));
      at.push_back({0.0, 0.0});
    }
  }

  void read(const Scene& scene, std::span<double> out) const {
    auto reading = out.begin();
    for (const auto& acceleration : axes_) {
      double product = 0.0, square = 0.0;
      for (const auto& span : slow_spans())
        for (std::size_t i = span.first; i < span.last; ++i) {
          product += acceleration[i] * scene.slow_dps[i];
          square += acceleration[i] * acceleration[i];
        }
      *reading++ = product / square;
    }
  }

 private:
  std::vector<std::vector<double>> axes_;
};

}  // namespace gyrostat::gap::lenses
