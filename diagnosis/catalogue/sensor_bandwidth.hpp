#pragma once

#include <algorithm>
#include <numbers>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/fitted_signature.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/generators/effects/sensor_bandwidth.hpp>

namespace gyrostat::gap {

/// The rate through a low-pass filter of one or two poles, of continuous time or over samples, or a
/// mean, each a start of its own.
template <>
struct Diagnosed<effects::SensorBandwidth> {
  static constexpr auto signature = Signature::repeated;
  static constexpr std::array free_parameters = {&effects::SensorBandwidth::cutoff_hz};

  /// One pole is what else would be expected: another form is chosen.
  static std::size_t chosen_parameters(const effects::SensorBandwidth& effect) {
    return effect.averages > 0.5 || effect.maximally_flat > 0.5 || effect.poles > 1.5 ? 1 : 0;
  }

  static std::vector<effects::SensorBandwidth> starts(const Evidence& e) {
    const double rate_hz = e.conditions().rate_hz();
    std::vector<effects::SensorBandwidth> all;
    for (const auto& form :
         {effects::SensorBandwidth{}, effects::SensorBandwidth{.poles = 2.0, .maximally_flat = 1.0},
          effects::SensorBandwidth{.averages = 1.0}, effects::SensorBandwidth{.continuous = 1.0},
          effects::SensorBandwidth{.poles = 2.0, .continuous = 1.0},
          effects::SensorBandwidth{.poles = 2.0, .maximally_flat = 1.0, .continuous = 1.0}})
      all.push_back(shaped(e, Trace::rate, form, &effects::SensorBandwidth::cutoff_hz,
                           0.002 * rate_hz, highest_hz(form, rate_hz)));
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
    if (!is_mean) all.push_back({.cutoff_hz = of_mean / delay_s, .averages = 1.0});
    for (const double continuous : {0.0, 1.0}) {
      const bool is_other_time = is_mean || effect.continuous != continuous;
      const auto add = [&](effects::SensorBandwidth form) {
        form.continuous = continuous;
        form.cutoff_hz = std::min(form.cutoff_hz, highest_hz(form, c.rate_hz()));
        all.push_back(form);
      };
      if (is_flat || is_other_time) add({.cutoff_hz = of_pole / delay_s});
      if (!is_flat || is_other_time)
        add({.cutoff_hz = of_butterworth / delay_s, .poles = 2.0, .maximally_flat = 1.0});
    }
    return all;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::motion(c); }

  static bool is_what_it_is_called(const effects::SensorBandwidth& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }

 private:
  /// Samples have no more than half their rate; what is sampled may have passed more.
  static constexpr double highest_hz(const effects::SensorBandwidth& form, double rate_hz) {
    return (form.continuous > 0.5 ? 2.0 : 0.49) * rate_hz;
  }
};

}  // namespace gyrostat::gap
