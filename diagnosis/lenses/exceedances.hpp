#pragma once

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Logarithm of the share of sample-to-sample steps beyond 3.5, 4.5, 6 and 9 robust standard
/// deviations: heavy tails. These come from the mean of the smaller nine tenths, since on a coarse
/// grid the median is one step of it or none.
struct Exceedances : Lens {
  static constexpr std::string_view title = "share of large steps over their size";
  static constexpr std::string_view channel = "gyro_dps";
  static constexpr std::string_view coordinate = "amplitude_dps";
  static constexpr std::string_view unit = "ln(1)";
  static constexpr double least_spread = 0.1;

  static constexpr std::array<double, 4> beyond = {3.5, 4.5, 6.0, 9.0};

  Exceedances(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    if (octave_count(spans()) == 0) return;
    for (std::size_t k = 0; k < beyond.size(); ++k)
      at.push_back({beyond[k], k + 1 < beyond.size() ? beyond[k + 1] : Interval::no_end});
  }

  void read(const Scene& scene, std::span<double> out) const {
    std::vector<double> steps;
    for (const auto& span : spans())
      for (std::size_t i = span.first + 1; i < span.last; ++i)
        steps.push_back(std::abs(scene.rate_error_dps[i] - scene.rate_error_dps[i - 1]));
    std::vector<double> sample;  // some thousands are enough
    for (std::size_t i = 0; i < steps.size(); i += 1 + steps.size() / 20000)
      sample.push_back(steps[i]);
    const auto smaller = sample.begin() + static_cast<std::ptrdiff_t>(9 * sample.size() / 10);
    std::nth_element(sample.begin(), smaller, sample.end());
    // Of a normal distribution: 2 (phi(0) - phi(1.645)) / 0.9.
    constexpr double mean_of_normal = 0.657348088946803;
    const double deviation = std::accumulate(sample.begin(), smaller, 0.0) /
                             static_cast<double>(smaller - sample.begin()) / mean_of_normal;
    std::array<double, beyond.size()> counts{};
    for (const double step : steps)
      for (std::size_t k = 0; k < beyond.size() && step > beyond[k] * deviation; ++k)
        counts[k] += 1.0;
    for (std::size_t k = 0; k < beyond.size(); ++k)
      out[k] = std::log((counts[k] + 2.0) / static_cast<double>(steps.size()));
  }
};

}  // namespace gyrostat::gap::lenses
