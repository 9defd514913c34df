#pragma once

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/diagnosis/starts/train_steps.hpp>
#include <gyrostat/generators/effects/magnetic_bursts.hpp>

namespace gyrostat::gap {

/// Stretches of the slow heading that lie six robust deviations away.
template <>
struct Diagnosed<effects::MagneticBursts> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::MagneticBursts::bursts_per_hour,
                                                 &effects::MagneticBursts::mean_duration_s,
                                                 &effects::MagneticBursts::std_deg};

  static std::vector<Start> starts(const Evidence& e) {
    std::vector<double> sizes;
    const auto& slow = e.scene.slow_heading_deg;
    const auto& conditions = e.conditions();
    for (const auto& span : conditions.slow_spans(Part::train))
      for (std::size_t i = span.first; i < span.last; ++i)
        if (!is_missing(slow[i])) sizes.push_back(slow[i]);
    const double centre = quantile(sizes, 0.5);
    for (double& size : sizes) size = std::abs(size - centre);
    const double limit = 6.0 * quantile(sizes, 0.5) / normal_quartile;
    double hit = 0.0, bursts = 0.0, square = 0.0;
    bool inside = false;
    for (const double size : sizes) {
      if (size > limit) {
        hit += 1.0;
        bursts += inside ? 0.0 : 1.0;
        square += size * size;
      }
      inside = size > limit;
    }
    const double interval_s = conditions.slow_interval_s();
    const double hours = static_cast<double>(sizes.size()) * interval_s / 3600.0;
    if (hit == 0.0)
      return with_noise_of(e,
                           effects::MagneticBursts{5.0 / std::max(hours, 0.1), 20.0, 2.0 * limit});
    return with_noise_of(
        e, effects::MagneticBursts{bursts / hours, std::max(hit * interval_s / bursts, interval_s),
                                   std::sqrt(square / hit)});
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::heading(c); }

  static bool is_what_it_is_called(const effects::MagneticBursts& effect, const Conditions& /*c*/) {
    return effect.std_deg < 90.0;  // more would turn the compass round
  }
};

}  // namespace gyrostat::gap
