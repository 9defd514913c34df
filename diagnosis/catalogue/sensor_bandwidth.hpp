#pragma once

#include <algorithm>
#include <numbers>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/sensor_bandwidth.hpp>

namespace gyrostat::gap {

/// The rate through a low-pass filter of one or two poles or a mean, each a start of its own.
template <>
struct Diagnosed<effects::SensorBandwidth> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::SensorBandwidth::cutoff_hz};

  static std::vector<effects::SensorBandwidth> starts(const Evidence& e) {
    const double rate_hz = e.conditions().rate_hz();
    std::vector<effects::SensorBandwidth> all;
    for (const auto& form :
         {effects::SensorBandwidth{}, effects::SensorBandwidth{.poles = 2.0, .maximally_flat = 1.0},
          effects::SensorBandwidth{.averages = 1.0}})
      all.push_back(shaped(e, Trace::rate, form, &effects::SensorBandwidth::cutoff_hz,
                           0.002 * rate_hz, 0.49 * rate_hz));
    return all;
  }

  /// The other forms that delay a slow motion by as much.
  static std::vector<effects::SensorBandwidth> told_otherwise(
      const effects::SensorBandwidth& effect, const Conditions& c) {
    // Of a cutoff of 1 Hz, in seconds.
    constexpr double of_pole = 0.5 / std::numbers::pi,
                     of_butterworth = of_pole * std::numbers::sqrt2,
                     of_mean = 0.5 * effects::SensorBandwidth::half_power_of_mean;
    const bool is_mean = effect.averages > 0.5, is_flat = !is_mean && effect.maximally_flat > 0.5;
    const double delay_s = (is_mean   ? of_mean
                            : is_flat ? of_butterworth
                                      : of_pole * effect.poles) /
                           effect.cutoff_hz;
    std::vector<effects::SensorBandwidth> all;
    const double most_hz = 0.49 * c.rate_hz();
    if (is_mean || is_flat) all.push_back({.cutoff_hz = of_pole / delay_s});
    if (!is_flat)
      all.push_back({.cutoff_hz = std::min(most_hz, of_butterworth / delay_s),
                     .poles = 2.0,
                     .maximally_flat = 1.0});
    if (!is_mean) all.push_back({.cutoff_hz = of_mean / delay_s, .averages = 1.0});
    return all;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  static bool is_what_it_is_called(const effects::SensorBandwidth& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
